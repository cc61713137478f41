#include "gi/rsm_views.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <utility>

#include "engine/core/check.h"
#include "gi/light_views.h"
#include "shaders/val_clustering/val_clustering_io.h"

namespace ag::gi {
namespace {

constexpr uint32_t kShareStep = 8;     // clusters: small changes of flux move nothing
constexpr float kFluxBand = 1.5f;      // within which a light's share stays
constexpr uint32_t kDarkFrames = 120;  // after which a light that went out gives up its share
constexpr uint32_t kNoMap = ~0u;
constexpr uint32_t kReflectingMapId = ~0u, kEmissiveMapId = ~1u;  // of RsmMap::id
constexpr uint64_t kMostTexels = 6 * 512 * 512;  // of all lights together: a point light's largest map

uint32_t facesOf(const RsmLight& light) {
    return light.kind == LightKind::kPoint ? 6 : 1;
}

uint32_t faceSize(const RsmLight& light, const RsmSettings& settings, uint32_t halvings) {
    const uint32_t wanted = settings.resolution ? settings.resolution : light.resolution;
    const uint32_t size = std::bit_floor(std::clamp(wanted, 32u, 1024u));
    return std::max((light.kind == LightKind::kPoint ? size / 2 : size) >> halvings, 32u);
}

// Many lights share the clusters, so that each needs fewer texels. Dark ones count: one that goes out does
// not change the others' maps.
uint32_t halvingsOf(std::span<const RsmLight> lights, const RsmSettings& settings) {
    uint64_t texels = 0;
    uint32_t count = 0, halvings = 0;
    for (const RsmLight& light : lights) {
        if (count++ >= io::kMaxBounceLights) continue;
        const uint64_t size = faceSize(light, settings, 0);
        texels += facesOf(light) * size * size;
    }
    for (; texels > kMostTexels; texels /= 4)
        ++halvings;
    return halvings;
}

LightView faceView(const RsmLight& light, uint32_t face, const Bounds& bounds, const RsmSettings& settings) {
    const float far = farDistanceOf(light.position, light.range, bounds);
    if (light.kind == LightKind::kDirectional) return sunView(light.direction, bounds, settings.sunMargin);
    if (light.kind == LightKind::kSpot)
        return spotView(light.position, light.direction, light.outerConeAngle, far);
    return cubeFaceView(light.position, face, far);
}

io::RsmMap mapOf(const RsmLight& light) {
    const ConeCosines cone = coneCosines(light);
    return {.position = light.position,
            .kind = uint32_t(light.kind),
            .direction = light.direction,
            .range = light.range,
            .intensity = light.intensity,
            .cosInner = cone.inner,
            .cosOuter = cone.outer,
            .id = uint32_t(light.id)};
}

// Largest faces first along shelves: powers of two then stay aligned to their own size.
void placeFaces(RsmLayout& layout) {
    std::array<uint32_t, io::kMaxRsmFaces> order{};
    for (uint32_t i = 0; i < layout.faceCount; ++i)
        order[i] = i;
    // Not stable_sort, which allocates: the index settles ties.
    std::sort(order.begin(), order.begin() + layout.faceCount, [&](uint32_t a, uint32_t b) {
        return std::pair(layout.faces[b].size, a) < std::pair(layout.faces[a].size, b);
    });
    const uint32_t width = std::max(layout.largestFace * (layout.faceCount > 1 ? 2 : 1), io::kRsmTileSize);
    glm::uvec2 cursor(0);
    uint32_t shelf = 0;
    for (uint32_t i = 0; i < layout.faceCount; ++i) {
        io::RsmFace& face = layout.faces[order[i]];
        if (cursor.x + face.size > width) cursor = {0, cursor.y + shelf};
        if (cursor.x == 0) shelf = face.size;
        face.origin = cursor;
        cursor.x += face.size;
    }
    layout.atlasSize = {width, cursor.y + shelf};
}

// Somebody who gets a share of the clusters: a light's map, lit or dark for the moment, or that of surfaces.
struct Sharer {
    float flux = 0;
    uint32_t map = kNoMap;
    uint32_t clusters = 0;
};
using Sharers = std::span<Sharer>;

// The light's flux as its share is made of it: what it was, unless its own is far from that.
ClusterShares::Light steadyLight(const RsmLight& light, float flux, const ClusterShares& before) {
    const auto known = std::ranges::find(before.lights.begin(), before.lights.begin() + before.count,
                                         light.id, &ClusterShares::Light::id);
    if (known == before.lights.begin() + before.count) return {light.id, flux, 0};
    if (flux == 0)
        return {light.id, known->darkFrames < kDarkFrames ? known->flux : 0, known->darkFrames + 1};
    const bool near = flux < known->flux * kFluxBand && flux * kFluxBand > known->flux;
    return {light.id, near ? known->flux : flux, 0};
}

// By flux, at least one step each, the largest remainders first: together all there are.
void shareSteps(Sharers sharers, uint32_t steps) {
    float total = 0;
    for (const Sharer& s : sharers)
        total += s.flux;
    const auto wanted = [&](const Sharer& s) {
        return total > 0 ? double(s.flux) / double(total) * steps : double(steps) / double(sharers.size());
    };
    const auto lack = [&](const Sharer& s) { return wanted(s) - s.clusters; };
    uint32_t given = 0;
    for (Sharer& s : sharers)
        given += s.clusters = std::max(uint32_t(wanted(s)), 1u);
    for (; given < steps; ++given)
        ++std::ranges::max_element(sharers, {}, lack)->clusters;
    for (; given > std::max(steps, uint32_t(sharers.size())); --given)
        --std::ranges::max_element(sharers, {}, [&](const Sharer& s) {
              return s.clusters > 1 ? -lack(s) : -1e30;
          })->clusters;
}

// Each map's clusters follow those of the one before; the largest share gets the budget's rest.
void shareClusters(RsmLayout& layout, Sharers sharers, uint32_t budget) {
    const uint32_t sharing = uint32_t(sharers.size());
    AG_CHECK_MSG(budget >= sharing, "two maps would have the same cluster");
    const uint32_t step = std::clamp(budget / sharing, 1u, kShareStep);  // so that each gets one
    shareSteps(sharers, budget / step);
    for (Sharer& s : sharers)
        s.clusters *= step;
    std::ranges::max_element(sharers, {}, &Sharer::clusters)->clusters += budget % step;
    uint32_t next = 0;
    for (const Sharer& s : sharers) {
        const uint32_t first = next, count = s.clusters;
        next += count;
        if (s.map == kNoMap) continue;
        io::RsmMap& map = layout.maps[s.map];
        map.firstCluster = first;
        map.clusterCount = count;
        if (map.kind == io::kMapOfSurfaces) {  // neighbours in space may lie anywhere in it
            map.clusterCount = std::min(count, io::kMaxCandidates);
            map.candidateRadius = layout.faces[map.firstFace].size / io::kRsmTileSize;
            continue;
        }
        const float side = float(layout.faces[map.firstFace].size) * std::sqrt(float(map.faceCount));
        const float cell = side / std::sqrt(float(map.clusterCount));
        map.candidateRadius = std::max(1u, uint32_t(std::ceil(2.0f * cell / float(io::kRsmTileSize))));
    }
}

float fluxOf(std::span<const Sharer> sharers) {
    float total = 0;
    for (const Sharer& s : sharers)
        total += s.flux;
    return total;
}

// A small sign in a sunlit room is seen beside light that is as weak as its own: its share falls as the cube
// root of its part of the power.
float emissiveWeight(float flux, float lights) {
    const float share = std::cbrt(flux / (flux + lights));
    return lights > 0 ? lights * share / std::max(1 - share, 1e-3f) : flux;
}

// `power`: W, of all that lights the scene.
void addPointMap(RsmLayout& layout, const PointMap& points, uint32_t id, float power) {
    layout.maps[layout.mapCount] = {
        .kind = io::kMapOfSurfaces,
        .direction = {0, -1, 0},
        .intensity = glm::vec3(std::max(power, 1e-20f)),  // a texel's part is much
        .tanHalf = 0.5f,
        .firstFace = layout.faceCount,
        .faceCount = 1,
        .id = id,
        .firstPoint = points.firstPoint};
    layout.faces[layout.faceCount++] = {.worldFromClip = glm::mat4(1),
                                        .clipFromWorld = glm::mat4(1),
                                        .size = points.side,
                                        .map = layout.mapCount++};
    layout.largestFace = std::max(layout.largestFace, points.side);
}

}  // namespace

ConeCosines coneCosines(const RsmLight& light) {
    if (light.kind != LightKind::kSpot) return {-2, -3};
    return {std::cos(light.innerConeAngle), std::cos(light.outerConeAngle)};
}

float emittedFlux(const RsmLight& light, const Bounds& sceneBounds) {
    const float mean = (light.intensity.x + light.intensity.y + light.intensity.z) / 3;
    if (light.kind == LightKind::kPoint) return mean * 4 * std::numbers::pi_v<float>;
    if (light.kind == LightKind::kSpot) {
        const float cosine = std::cos(0.5f * (light.innerConeAngle + light.outerConeAngle));
        return mean * 2 * std::numbers::pi_v<float> * (1 - cosine);
    }
    const float half = sunView(light.direction, sceneBounds, 0).tanHalf;
    return mean * 4 * half * half;
}

namespace {

void addFace(RsmLayout& layout, const LightView& view, uint32_t size) {
    io::RsmFace& face = layout.faces[layout.faceCount++];
    face.clipFromWorld = view.clipFromWorld;
    face.worldFromClip = glm::mat4(glm::inverse(glm::dmat4(view.clipFromWorld)));
    face.size = size;
    face.map = layout.mapCount;
    layout.largestFace = std::max(layout.largestFace, size);
    io::RsmMap& map = layout.maps[layout.mapCount];
    map.tanHalf = view.tanHalf;
    ++map.faceCount;
}

io::RsmMap& beginMap(RsmLayout& layout, const RsmLight& light) {
    layout.lightIds[layout.mapCount] = light.id;
    io::RsmMap& map = layout.maps[layout.mapCount] = mapOf(light);
    map.firstFace = layout.faceCount;
    return map;
}

void addLightRsm(RsmLayout& layout, const RsmLight& light, const Bounds& bounds, const RsmSettings& settings,
                 uint32_t size) {
    beginMap(layout, light);
    for (uint32_t f = 0; f < facesOf(light); ++f)
        addFace(layout, faceView(light, f, bounds, settings), size);
    ++layout.mapCount;
}

void addSunLevels(RsmLayout& layout, const RsmLight& sun, std::span<const SunLevel> levels, uint32_t size) {
    for (uint32_t i = 0; i < levels.size(); ++i) {
        io::RsmMap& map = beginMap(layout, sun);
        map.id ^= i * 0x9e3779b9u;
        map.holeBegin = levels[i].holeBegin;
        map.holeSize = levels[i].holeSize;
        addFace(layout, levels[i].view, size);
        ++layout.mapCount;
    }
}

}  // namespace

RsmLayout layoutRsm(const World& world, const RsmSettings& settings, uint32_t clusterBudget,
                    RsmHistory& history, const SurfaceEmitters& emitters, const SunFocus& focus) {
    RsmLayout layout;
    ClusterShares& shares = history.shares;
    const ClusterShares before = std::exchange(shares, {});
    std::array<Sharer, io::kMaxRsmMaps> sharers{};
    uint32_t sharing = 0;
    const uint32_t halvings = halvingsOf(world.lights, settings);
    bool hadSun = false;
    for (const RsmLight& light : world.lights) {
        if (shares.count == io::kMaxBounceLights) break;
        const bool dark = light.intensity == glm::vec3(0);
        const auto steady =
            steadyLight(light, dark ? 0 : emittedFlux(light, world.bounds) * light.budgetShare, before);
        if (dark && steady.flux == 0) continue;
        shares.lights[shares.count++] = steady;
        const uint32_t size = faceSize(light, settings, halvings);
        std::array<SunLevel, io::kMostSunLevels> room;
        std::span<const SunLevel> levels;
        if (light.kind == LightKind::kDirectional && !std::exchange(hadSun, true))
            levels = layOutSunLevels(faceView(light, 0, world.bounds, settings), size, focus,
                                     settings.sunDetail, history.sunLevels, room);
        const uint32_t maps = std::max(uint32_t(levels.size()), 1u);
        for (uint32_t i = 0; i < maps; ++i)
            sharers[sharing++] = {steady.flux / float(maps), dark ? kNoMap : layout.mapCount + i};
        if (dark) continue;
        if (levels.empty())
            addLightRsm(layout, light, world.bounds, settings, size);
        else
            addSunLevels(layout, light, levels, size);
    }
    layout.lightMapCount = layout.mapCount, layout.lightFaceCount = layout.faceCount;
    const bool shines = emitters.emissive.side > 0;
    if (shines) {
        const float lights = fluxOf({sharers.data(), sharing});
        ++sharing;
        std::shift_right(sharers.begin(), sharers.begin() + sharing, 1);
        sharers[0] = {emissiveWeight(emitters.emissiveFlux, lights), layout.mapCount};
        addPointMap(layout, emitters.emissive, kEmissiveMapId, lights + emitters.emissiveFlux);
    }
    if (emitters.reflecting.side > 0) {
        const float power = fluxOf({sharers.data(), sharing}), share = emitters.reflectingShare;
        // Of lights without a map all clusters are points'.
        const float weight = (power * share + emitters.otherFlux) / std::max(1 - share, 0.01f);
        sharers[sharing++] = {weight, layout.mapCount};
        addPointMap(layout, emitters.reflecting, kReflectingMapId, power + emitters.otherFlux);
    }
    if (layout.mapCount == 0) return layout;
    placeFaces(layout);
    shareClusters(layout, {sharers.data(), sharing}, clusterBudget);
    layout.emissiveClusters = shines ? sharers[0].clusters : 0;
    return layout;
}

}  // namespace ag::gi
