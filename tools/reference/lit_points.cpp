#include "tools/reference/lit_points.h"

#include <algorithm>
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
constexpr double kLearned = 0.8;  // share of the chances, once there is enough to learn from
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
    for (uint32_t l = 0; l < lights.size(); ++l) {
        const RenderLight& light = lights[l].light;
        Map map{{faceCount(light), resolution}, uint32_t(power_.size()), light.castsShadow};
        maps_.push_back(map);
        if (!map.used) continue;
        for (uint32_t t = 0; t < map.shape.texels(); ++t) {
            const uint32_t face = t / (resolution * resolution);
            const glm::vec2 ndc = texelCenter(map.shape, t % (resolution * resolution));
            power_.push_back(double(mean(beamAt(light, scene.scene().bounds, face, ndc, resolution).power)));
            lightOfTexel_.push_back(l);
        }
    }
    worth_.assign(power_.size(), 0);
    total_ = std::reduce(power_.begin(), power_.end());
    if (!empty()) setChances(power_);
}

void LitPoints::setChances(std::span<const double> weights) {
    cumulative_.assign(weights.begin(), weights.end());
    std::partial_sum(cumulative_.begin(), cumulative_.end(), cumulative_.begin());
    const double sum = cumulative_.back();
    for (double& c : cumulative_)
        c /= sum;
    cumulative_.back() = 1;
}

LitPoint LitPoints::pointOn(uint32_t light, const Surface& at, glm::vec3 irradiance) const {
    const Map& map = maps_[light];
    LitPoint point{.position = at.position, .normal = at.geometricNormal};
    if (!map.used) return point;
    const RenderLight& l = scene_.lights()[light].light;
    const MapPlace place = placeOnMap(l, scene_.scene().bounds, at.position, map.shape.resolution);
    if (!place.inside) return point;
    const uint32_t n = map.shape.resolution;
    const glm::uvec2 t = glm::min(glm::uvec2((place.ndc * 0.5f + 0.5f) * float(n)), glm::uvec2(n - 1));
    const uint32_t texel = map.firstTexel + (place.face * n + t.y) * n + t.x;
    const glm::vec3 d = at.position - l.position;
    const bool sun = l.kind == LightKind::kDirectional;
    const float cosine = std::abs(glm::dot(at.geometricNormal, sun ? l.direction : glm::normalize(d)));
    point.density = float(chanceOf(texel)) / place.spread * cosine / (sun ? 1 : glm::dot(d, d));
    if (point.density > 0) point.brightness = brightnessOf(irradiance / point.density, at);
    return point;
}

void LitPoints::addPoint(uint32_t texel, glm::vec2 inTexel, uint64_t& rays) {
    const uint32_t l = lightOfTexel_[texel];
    const Map& map = maps_[l];
    const RenderLight& light = scene_.lights()[l].light;
    const uint32_t n = map.shape.resolution, inMap = texel - map.firstTexel, inFace = inMap % (n * n);
    const glm::vec2 at(inFace % n, inFace / n);
    const glm::vec2 ndc = (at + inTexel) / float(n) * 2.0f - 1.0f;
    const Beam beam = beamAt(light, scene_.scene().bounds, inMap / (n * n), ndc, n);
    LitPoint& point = points_.emplace_back();
    LitPointSource& source = sources_.emplace_back();
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

void LitPoints::draw(uint32_t count, uint32_t seed, uint64_t& rays) {
    points_.clear();
    sources_.clear();
    if (empty()) return;
    Random random{uint64_t(io::hashUint(seed)) << 32 | seed};
    random.next();
    uint32_t texel = 0;
    for (uint32_t i = 0; i < count; ++i) {
        const double u = (i + double(random.next())) / count;
        while (texel + 1 < cumulative_.size() && cumulative_[texel] <= u)
            ++texel;
        const glm::vec2 inTexel(random.next(), random.next());
        addPoint(texel, inTexel, rays);
    }
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

void TilePoints::choose(const LitPoints& lit, const Surface* surface, float spread, double usualSum,
                        uint32_t seed) {
    lit_ = &lit;
    table_.clear();
    usualSum_ = sum_ = 0;
    if (!surface) return;
    position_ = surface->position, normal_ = surface->geometricNormal, spread_ = spread;
    const auto points = lit.points();
    shares_.resize(points.size());
    for (size_t i = 0; i < points.size(); ++i) {
        shares_[i] = points[i].brightness * roughGeometry(points[i], position_, normal_, spread_);
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

float TilePoints::usuallyOftener(const LitPoint& point) const {
    if (!(usualSum_ > 0)) return 1;
    const float share =
        point.brightness * roughGeometry(point, position_, normal_, spread_) / float(usualSum_);
    return 0.5f + 0.5f * share;
}

}  // namespace ag::reference
