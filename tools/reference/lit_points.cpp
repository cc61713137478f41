#include "tools/reference/lit_points.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>
#include <numeric>

#include "common/lights.h"
#include "common/sampling.h"
#include "tools/reference/random.h"

namespace ag::reference {
namespace {

constexpr uint32_t kTexels = 1 << 16;  // of all lights together
constexpr uint32_t kMostResolution = 256, kLeastResolution = 4;
constexpr uint32_t kPointsAtOnce = 512;
constexpr uint32_t kCellSide = 8;  // texels
constexpr double kLearned = 0.8;   // share of the chances, once there is enough to learn from
constexpr double kEnoughNotes = 1000;
constexpr float kGlossOfTarget = 0.1f;  // metals send light, too

// About what a surface sends of what arrives, W/sr.
float brightnessOf(glm::vec3 arriving, const Surface& s) {
    return mean(arriving * (s.albedo + kGlossOfTarget * s.baseColor)) * std::numbers::inv_pi_v<float>;
}

glm::vec2 texelCenter(const BeamMap& map, uint32_t inFace) {
    const glm::vec2 at(inFace % map.resolution, inFace / map.resolution);
    return (at + 0.5f) / float(map.resolution) * 2.0f - 1.0f;
}

}  // namespace

LitPoints::LitPoints(const RayScene& scene) : scene_(scene) {
    const auto& lights = scene.lights();
    uint32_t faces = 0;
    for (const PreparedLight& l : lights)
        faces += faceCount(l.light);
    const auto side = uint32_t(std::sqrt(double(kTexels) / std::max(faces, 1u)));
    const uint32_t resolution = std::clamp(side, kLeastResolution, kMostResolution);
    for (uint32_t l = 0; l < lights.size(); ++l)
        addMap(l, resolution);
    worth_.assign(power_.size(), 0);
    total_ = std::reduce(power_.begin(), power_.end());
    if (!empty()) setChances(power_);
}

void LitPoints::addMap(uint32_t l, uint32_t resolution) {
    const RenderLight& light = scene_.lights()[l].light;
    Map map{{faceCount(light), resolution}, uint32_t(power_.size()), light.castsShadow};
    maps_.push_back(map);
    if (!map.used) return;
    const uint32_t cells = (resolution + kCellSide - 1) / kCellSide;
    for (uint32_t t = 0; t < map.shape.texels(); ++t) {
        const uint32_t face = t / (resolution * resolution), inFace = t % (resolution * resolution);
        const glm::vec2 ndc = texelCenter(map.shape, inFace);
        power_.push_back(double(mean(beamAt(light, scene_.scene().bounds, face, ndc, resolution).power)));
        lightOfTexel_.push_back(l);
        const glm::uvec2 cell = glm::uvec2(inFace % resolution, inFace / resolution) / kCellSide;
        cellOfTexel_.push_back(cellCount_ + (face * cells + cell.y) * cells + cell.x);
    }
    cellCount_ += map.shape.faces * cells * cells;
}

void LitPoints::setTileCount(uint32_t count) {
    if (tiles_.size() == count) return;
    tiles_.assign(count, {});
    for (Tile& tile : tiles_)
        tile.sights.resize(cellCount_);
}

void LitPoints::setChances(std::span<const double> weights) {
    cumulative_.assign(weights.begin(), weights.end());
    std::partial_sum(cumulative_.begin(), cumulative_.end(), cumulative_.begin());
    const double sum = cumulative_.back();
    for (double& c : cumulative_)
        c /= sum;
    cumulative_.back() = 1;
}

LitPlace LitPoints::pointOn(uint32_t light, const Surface& at, glm::vec3 irradiance) const {
    const Map& map = maps_[light];
    LitPlace point;
    point.position = at.position, point.normal = at.geometricNormal;
    if (!map.used) return point;
    const RenderLight& l = scene_.lights()[light].light;
    const MapPlace place = placeOnMap(l, scene_.scene().bounds, at.position, map.shape.resolution);
    if (!place.inside) return point;
    const uint32_t n = map.shape.resolution;
    const glm::uvec2 t = glm::min(glm::uvec2((place.ndc * 0.5f + 0.5f) * float(n)), glm::uvec2(n - 1));
    const uint32_t texel = map.firstTexel + (place.face * n + t.y) * n + t.x;
    point.cell = cellOfTexel_[texel];
    const glm::vec3 d = at.position - l.position;
    const bool sun = l.kind == LightKind::kDirectional;
    const float cosine = std::abs(glm::dot(at.geometricNormal, sun ? l.direction : glm::normalize(d)));
    point.density = float(chanceOf(texel)) / place.spread * cosine / (sun ? 1 : glm::dot(d, d));
    if (point.density > 0) point.brightness = brightnessOf(irradiance / point.density, at);
    return point;
}

void LitPoints::placePoint(uint32_t index, uint32_t texel, glm::vec2 inTexel, uint64_t& rays) {
    const uint32_t l = lightOfTexel_[texel];
    const Map& map = maps_[l];
    const RenderLight& light = scene_.lights()[l].light;
    const uint32_t n = map.shape.resolution, inMap = texel - map.firstTexel, inFace = inMap % (n * n);
    const glm::vec2 at(inFace % n, inFace / n);
    const glm::vec2 ndc = (at + inTexel) / float(n) * 2.0f - 1.0f;
    const Beam beam = beamAt(light, scene_.scene().bounds, inMap / (n * n), ndc, n);
    LitPoint& point = points_[index];
    LitPointSource& source = sources_[index];
    source.toLight = -beam.direction;
    source.texel = texel;
    Surface& s = source.surface;
    if (mean(beam.power) <= 0) return;
    ++rays;
    if (!scene_.intersect(beam.origin, beam.direction, s) || s.hidden) return;
    scene_.resolve(s);
    const float cosine = -glm::dot(s.geometricNormal, beam.direction),
                shading = -glm::dot(s.normal, beam.direction);
    if (!(cosine > 0) || !(shading > 0)) return;
    const bool sun = light.kind == LightKind::kDirectional;
    const auto chance = float(chanceOf(texel));
    source.arriving = beam.power / chance * (shading / cosine);
    if (!sun) source.arriving *= io::rangeWindow(s.distance, light.range);
    point.position = s.position;
    point.normal = s.geometricNormal;
    point.density = chance / beam.spread * cosine / (sun ? 1 : s.distance * s.distance);
    point.brightness = brightnessOf(source.arriving, s);
}

void LitPoints::draw(uint32_t count, uint32_t seed, JobRunner& runner, uint64_t& rays) {
    if (empty()) return;
    points_.assign(count, {});
    sources_.assign(count, {});
    std::atomic<uint64_t> traced{0};
    runner.parallelFor(count, kPointsAtOnce, [&](uint32_t begin, uint32_t end) {
        uint64_t own = 0;
        for (uint32_t i = begin; i < end; ++i) {
            Random random{uint64_t(io::hashUint(seed ^ io::hashUint(i))) << 32 | seed};
            const double along = (i + double(random.next())) / count;
            const auto found = std::ranges::upper_bound(cumulative_, along);
            const auto texel = uint32_t(std::min(found, cumulative_.end() - 1) - cumulative_.begin());
            const float x = random.next();
            placePoint(i, texel, {x, random.next()}, own);
        }
        traced += own;
    });
    rays += traced;
}

void LitPoints::note(std::span<const LitPointWorth> worths) {
    for (const LitPointWorth& w : worths)
        worth_[w.texel] += double(w.worth);
    noted_ += double(worths.size());
}

// With the eight texels about it: few have brought something often.
double LitPoints::smoothed(const std::vector<double>& values, uint32_t texel) const {
    const Map& map = maps_[lightOfTexel_[texel]];
    const int n = int(map.shape.resolution);
    const uint32_t inMap = texel - map.firstTexel,
                   face = map.firstTexel + inMap / uint32_t(n * n) * uint32_t(n * n);
    const int x = int(inMap) % n, y = int(inMap) / n % n;
    double sum = 0;
    for (int dy = std::max(y - 1, 0); dy <= std::min(y + 1, n - 1); ++dy)
        for (int dx = std::max(x - 1, 0); dx <= std::min(x + 1, n - 1); ++dx)
            sum += values[face + uint32_t(dy * n + dx)];
    return sum;
}

void LitPoints::learn() {
    if (empty() || noted_ == 0) return;
    std::vector<double> chances(power_.size());
    for (uint32_t t = 0; t < chances.size(); ++t)
        chances[t] = smoothed(worth_, t);
    const double sum = std::reduce(chances.begin(), chances.end());
    if (!(sum > 0)) return;
    const double share = kLearned * noted_ / (noted_ + kEnoughNotes);
    for (uint32_t t = 0; t < chances.size(); ++t)
        chances[t] = share * chances[t] / sum + (1 - share) * power_[t] / total_;
    setChances(chances);
}

float TilePoints::matters(const LitPoint& point, uint32_t cell) const {
    float geometry = 0;
    for (uint32_t i = 0; i < surfaces_.count; ++i)
        geometry += roughGeometry(point, surfaces_.at[i]->position, surfaces_.at[i]->geometricNormal,
                                  surfaces_.spread);
    return point.brightness * geometry * chances_[cell];
}

void TilePoints::note(uint32_t point, bool seen) {
    if (!sights_.empty()) sights_[lit_->cell(point)].note(seen);
}

void TilePoints::choose(const LitPoints& lit, const TileSurfaces& surfaces, double usualSum,
                        std::span<Sight> sights, uint32_t seed) {
    lit_ = &lit;
    table_.clear();
    usualSum_ = sum_ = 0;
    surfaces_ = surfaces;
    sights_ = sights;
    if (surfaces.count == 0) return;
    chances_.resize(sights.size());
    std::ranges::transform(sights, chances_.begin(), &Sight::chance);
    const auto points = lit.points();
    shares_.resize(points.size());
    for (uint32_t i = 0; i < points.size(); ++i) {
        shares_[i] = points[i].brightness > 0 ? matters(points[i], lit.cell(i)) : 0;
        sum_ += double(shares_[i]);
    }
    sum_ /= double(points.size());
    if (!(sum_ > 0)) return;
    usualSum_ = usualSum;
    for (float& share : shares_)
        share /= float(sum_);
    // Systematic resampling: each point as often as its share asks, rounded up or down.
    table_.reserve(points.size() + 1);
    double along = 0, next = double(io::hashToUnit(seed));
    for (uint32_t i = 0; i < points.size(); ++i)
        for (along += double(shares_[i]); next < along; next += 1)
            table_.push_back(i);
}

uint32_t TilePoints::candidate(bool matters, float place) const {
    const bool chosen = matters && !table_.empty();
    const size_t size = chosen ? table_.size() : lit_->points().size();
    const auto at = std::min(size_t(place * float(size)), size - 1);
    return chosen ? table_[at] : uint32_t(at);
}

}  // namespace ag::reference
