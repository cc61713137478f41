#include "tools/reference/path_lanes.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

namespace ag::reference {
namespace {

constexpr float kInvPi = std::numbers::inv_pi_v<float>;
// Of lit points for each connection: half from those that matter to the tile, half from all.
constexpr uint32_t kCandidates = 8;
constexpr float kSharing = RayLanes::kCount;
constexpr uint32_t kFirstRoulette = 3;  // bounce
constexpr float kLeastSurvival = 0.1f;

float greatest(glm::vec3 v) {
    return std::max({v.x, v.y, v.z});
}

}  // namespace

void traceThrough(const RayScene& scene, PathStart start, bool glossy, PixelSums& sums, uint64_t& rays) {
    const Surface& first = *start.surface;
    const DirectionSample sample = sampleDirection(first, start.toViewer, glossy, start.uv.x, start.uv.y,
                                                   glossy ? start.random.next() : 0);
    if (sample.incident <= 0 || glm::dot(sample.direction, first.geometricNormal) <= 0) return;
    Surface met;
    glm::vec3 origin = leaveSurface(scene, first);
    while (++rays, scene.intersect(origin, sample.direction, met)) {
        const glm::vec3 back = -sample.direction;
        Lit lit;
        directLight(scene, {.active = 1, .surfaces = &met, .toViewer = &back, .lit = &lit}, glossy, rays,
                    kAllCounts);
        sums.add(1, lit.radiance * sample.incident, lit.radiance * sample.reflected);
        // Far enough not to meet the same plane again when it is grazed.
        const float slant = std::abs(glm::dot(sample.direction, met.geometricNormal));
        origin = met.position + sample.direction * (scene.offset() / std::max(slant, 1e-3f));
    }
}

PathLanes::PathLanes(const RayScene& scene, const PathSettings& settings, const LitPoints* lit)
    : scene_(scene),
      settings_(settings),
      lit_(lit && !lit->empty() && !lit->points().empty() ? lit : nullptr),
      emission_(settings.emission && scene.sources().anyEmissive()),
      sky_(scene.sources().anySky()) {}

void PathLanes::begin(uint32_t lane, const PathStart& start) {
    Lane& l = lanes_[lane];
    l.at = start.surface, l.toViewer = start.toViewer, l.uv = start.uv, l.source = start.source;
    l.random = start.random;
    l.irradianceWeight = glm::vec3(1);
    l.radianceWeight = start.seenAs;
    alive_ |= 1u << lane;
}

void PathLanes::beginTile(const TileSurfaces& surfaces, double usualSum, std::span<Sight> sights,
                          uint32_t seed) {
    if (!lit_) return;
    tile_.choose(*lit_, surfaces, usualSum, sights, seed);
    all_.choose(*lit_, {}, 0, {}, 0);
}

void PathLanes::trace(PixelSums& sums, std::vector<LitPointWorth>& worths) {
    const uint32_t last = settings_.bounces + (emission_ || sky_ ? 1 : 0);
    for (uint32_t bounce = 1; bounce <= last && alive_; ++bounce) {
        if (lit_ && bounce <= settings_.bounces) connect(bounce, sums, worths);
        meetSources(bounce, sums);
        Surface* met = met_[bounce % 2];
        step(bounce, met, sums);
        if (bounce <= settings_.bounces) receive(bounce, met, sums);
        forEachLane(bounce < last ? alive_ : 0, [&](uint32_t i) {
            scene_.resolve(met[i]);
            lanes_[i].at = &met[i];
        });
    }
    alive_ = 0;
}

// Of candidates on the lit surface, 1/m², for weights. The picture's surfaces have their tile's choice of
// points. The paths of a packet share the points: what several find together is worth less than what each
// finds alone (Grittmann et al. 2021).
float PathLanes::densityOfConnections(uint32_t bounce, uint32_t point) const {
    const float oftener = bounce == 1 ? tile_.usuallyOftener(point) : 1;
    return kCandidates / kSharing * lit_->points()[point].density * oftener;
}

// As bridgeTo().geometry x brightness between Lambert surfaces, without roots: what candidates are judged by.
float PathLanes::roughlySent(uint32_t bounce, const Lane& l, glm::vec3 from, uint32_t point) const {
    const LitPoint& p = lit_->points()[point];
    const glm::vec3 d = p.position - from;
    const float received = glm::dot(l.at->normal, d), sent = -glm::dot(p.normal, d);
    if (!(received > 0) || !(sent > 0)) return 0;
    const float square = glm::dot(d, d), cosines = received * sent, own = densityOfConnections(bounce, point);
    return p.brightness * cosines * own / (own * square * square + cosines * kInvPi);
}

// 0 where one of both looks away.
PathLanes::Bridge PathLanes::bridgeTo(uint32_t bounce, const Lane& l, glm::vec3 from, uint32_t point) const {
    const LitPoint& p = lit_->points()[point];
    Bridge b{.point = point};
    const glm::vec3 d = p.position - from;
    b.distance = glm::length(d);
    b.direction = d / std::max(b.distance, 1e-20f);
    const float nl = glm::dot(l.at->normal, b.direction), ny = -glm::dot(p.normal, b.direction);
    if (!(nl > 0) || !(ny > 0) || glm::dot(l.at->geometricNormal, b.direction) <= 0) return b;
    // Balance heuristic: both densities on the lit surface, 1/m².
    const float perArea = ny / (b.distance * b.distance), own = densityOfConnections(bounce, point);
    const float other = densityOf(*l.at, l.toViewer, b.direction, settings_.glossy);  // 1/sr
    b.geometry = nl * own / (own / perArea + other);
    return b;
}

// Of some candidates one, by what they would send (resampled importance sampling; Talbot, Cline and Egbert
// 2005). False: none sends anything.
bool PathLanes::chooseBridge(uint32_t bounce, Lane& l, glm::vec3 from, Bridge& chosen, float& weight) const {
    const TilePoints& choice = bounce == 1 ? tile_ : all_;
    float total = 0, target = 0;
    uint32_t taken = 0;
    for (uint32_t c = 0; c < kCandidates; ++c) {
        const uint32_t point = choice.candidate(c % 2 == 0, l.random.next());
        const float sends = roughlySent(bounce, l, from, point);
        const float worth = sends / choice.oftener(point);
        if (!(worth > 0)) continue;
        total += worth;
        if (l.random.next() * total < worth) taken = point, target = sends;
    }
    if (!(target > 0)) return false;
    chosen = bridgeTo(bounce, l, from, taken);
    weight = total / (target * kCandidates);
    return chosen.geometry > 0;
}

// A lit point each, where it sees the path's last surface.
void PathLanes::connect(uint32_t bounce, PixelSums& sums, std::vector<LitPointWorth>& worths) {
    RayLanes rays;
    Bridge chosen[RayLanes::kCount];
    float weight[RayLanes::kCount];
    forEachLane(alive_, [&](uint32_t i) {
        const glm::vec3 from = leaveSurface(scene_, *lanes_[i].at);
        if (chooseBridge(bounce, lanes_[i], from, chosen[i], weight[i]))
            rays.set(i, from, chosen[i].direction, chosen[i].distance - 2 * scene_.offset());
    });
    rays_ += uint64_t(std::popcount(rays.active));
    const uint32_t visible = scene_.visible(rays);
    forEachLane(bounce == 1 && lit_->learns() ? rays.active : 0,
                [&](uint32_t i) { tile_.note(chosen[i].point, visible >> i & 1); });
    forEachLane(visible, [&](uint32_t i) {
        const Lane& l = lanes_[i];
        const Bridge& b = chosen[i];
        const LitPointSource& p = lit_->source(b.point);
        const glm::vec3 sent = p.arriving * brdf(p.surface, -b.direction, p.toLight, settings_.glossy);
        const glm::vec3 arrives = sent * (b.geometry * weight[i]);
        const glm::vec3 reflected = arrives * brdf(*l.at, l.toViewer, b.direction, settings_.glossy);
        const glm::vec3 irradiance = l.irradianceWeight * (bounce == 1 ? arrives : reflected);
        sums.add(bounce, irradiance, l.radianceWeight * reflected);
        if (lit_->learns()) worths.push_back({p.texel, irradiance.x + irradiance.y + irradiance.z});
    });
}

// Russian roulette (Arvo and Kirk 1990) by what the last surface sends on; those that go on count for all.
bool PathLanes::goesOn(uint32_t bounce, Lane& l, glm::vec3& reflected) const {
    if (bounce < kFirstRoulette) return true;
    const float survival = std::clamp(greatest(reflected), kLeastSurvival, 1.0f);
    if (survival < 1 && l.random.next() >= survival) return false;
    reflected /= survival;
    return true;
}

// What shines by itself, chosen by how bright it is, where it sees the path's last surface. Directions drawn
// from that surface find it, too; the balance heuristic weighs both.
void PathLanes::meetSources(uint32_t bounce, PixelSums& sums) {
    const auto meet = [&](Shining source, auto&& draw) {
        RayLanes rays;
        SourceSample samples[RayLanes::kCount];
        forEachLane(alive_, [&](uint32_t i) {
            const Lane& l = lanes_[i];
            const glm::vec3 from = leaveSurface(scene_, *l.at);
            const SourceSample& s = samples[i] = draw(from, l.source);
            if (!(s.density > 0) || s.radiance == glm::vec3(0)) return;
            if (glm::dot(l.at->normal, s.direction) > 0 && glm::dot(l.at->geometricNormal, s.direction) > 0)
                rays.set(i, from, s.direction, s.distance - 2 * scene_.offset());
        });
        rays_ += uint64_t(std::popcount(rays.active));
        forEachLane(scene_.visible(rays), [&](uint32_t i) {
            const Lane& l = lanes_[i];
            const SourceSample& s = samples[i];
            const float other = densityOf(*l.at, l.toViewer, s.direction, settings_.glossy);
            const glm::vec3 arrives =
                s.radiance * (glm::dot(l.at->normal, s.direction) / (s.density + other));
            const glm::vec3 reflected = arrives * brdf(*l.at, l.toViewer, s.direction, settings_.glossy);
            sums.addFrom(source, bounce - 1, l.irradianceWeight * (bounce == 1 ? arrives : reflected),
                         l.radianceWeight * reflected);
        });
    };
    forEachLane(bounce > 1 && (emission_ || sky_) ? alive_ : 0, [&](uint32_t i) {
        for (int c = 0; c < 3; ++c)
            lanes_[i].source[c] = lanes_[i].random.next();
    });
    const LightSources& sources = scene_.sources();
    if (emission_)
        meet(Shining::kSurface,
             [&](glm::vec3 from, glm::vec3 even) { return sources.drawEmissive(from, even); });
    if (sky_) meet(Shining::kSky, [&](glm::vec3, glm::vec3 even) { return sources.drawSky(even); });
}

// What shines by itself, where the paths met it.
void PathLanes::findSources(uint32_t bounce, uint32_t escaped, Surface* met, PixelSums& sums) const {
    const LightSources& sources = scene_.sources();
    const auto add = [&](uint32_t i, Shining source, glm::vec3 radiance, float other) {
        const Lane& l = lanes_[i];
        const glm::vec3 counts = radiance * (l.density / (l.density + other));
        sums.addFrom(source, bounce - 1, l.irradianceWeight * counts, l.radianceWeight * counts);
    };
    forEachLane(sky_ ? escaped : 0, [&](uint32_t i) {
        const glm::vec3 along = lanes_[i].direction;
        add(i, Shining::kSky, scene_.skyAlong(along), sources.skyDensity(along));
    });
    forEachLane(emission_ ? alive_ : 0, [&](uint32_t i) {
        scene_.resolve(met[i]);
        if (met[i].emissive == glm::vec3(0)) return;
        add(i, Shining::kSurface, met[i].emissive,
            sources.emissiveDensity(met[i], leaveSurface(scene_, *lanes_[i].at), lanes_[i].direction));
    });
}

// On to the next surfaces, with what shines there.
void PathLanes::step(uint32_t bounce, Surface* met, PixelSums& sums) {
    RayLanes rays;
    forEachLane(alive_, [&](uint32_t i) {
        Lane& l = lanes_[i];
        if (bounce > 1) l.uv = {l.random.next(), l.random.next()};
        const float choice = settings_.glossy ? l.random.next() : 0;
        DirectionSample sample = sampleDirection(*l.at, l.toViewer, settings_.glossy, l.uv.x, l.uv.y, choice);
        if (sample.incident <= 0 || glm::dot(sample.direction, l.at->geometricNormal) <= 0) return;
        if (!goesOn(bounce, l, sample.reflected)) return;
        l.irradianceWeight *= bounce == 1 ? glm::vec3(sample.incident) : sample.reflected;
        l.radianceWeight *= sample.reflected;
        l.direction = sample.direction;
        l.density = sample.density;
        rays.set(i, leaveSurface(scene_, *l.at), sample.direction, INFINITY);
    });
    rays_ += uint64_t(std::popcount(rays.active));
    alive_ = scene_.intersect(rays, met);
    forEachLane(alive_, [&](uint32_t i) { lanes_[i].toViewer = -lanes_[i].direction; });
    findSources(bounce, rays.active & ~alive_, met, sums);
}

// Direct light of the surfaces just met.
void PathLanes::receive(uint32_t bounce, Surface* met, PixelSums& sums) {
    glm::vec3 toViewer[RayLanes::kCount];
    Lit lit[RayLanes::kCount];
    forEachLane(alive_, [&](uint32_t i) { toViewer[i] = lanes_[i].toViewer; });
    const auto weight = [&](uint32_t i, uint32_t light, glm::vec3 irradiance) {
        if (!lit_) return 1.0f;
        const Surface& s = met[i];
        const float perSteradian = s.distance * s.distance / glm::dot(s.geometricNormal, toViewer[i]);
        const LitPlace place = lit_->pointOn(light, s, irradiance);
        const float oftener = bounce == 1 ? tile_.usuallyOftener(place) : 1;
        const float other = kCandidates / kSharing * place.density * oftener * perSteradian;
        return lanes_[i].density / (lanes_[i].density + other);
    };
    directLight(scene_, {.active = alive_, .surfaces = met, .toViewer = toViewer, .lit = lit},
                settings_.glossy, rays_, weight);
    forEachLane(alive_, [&](uint32_t i) {
        const Lane& l = lanes_[i];
        if (lit[i].radiance != glm::vec3(0))
            sums.add(bounce, l.irradianceWeight * lit[i].radiance, l.radianceWeight * lit[i].radiance);
    });
}

}  // namespace ag::reference
