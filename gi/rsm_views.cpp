#include "gi/rsm_views.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <utility>

#include "gi/light_views.h"
#include "shaders/val_clustering/val_clustering_io.h"

namespace ag::gi {
namespace {

constexpr uint32_t kMinClustersPerMap = 8;

uint32_t facesOf(const RenderLight& light) {
    return light.kind == LightKind::kPoint ? 6 : 1;
}

uint32_t faceSize(const RenderLight& light, const RsmSettings& settings) {
    const uint32_t wanted = settings.resolution ? settings.resolution : light.rsmResolution;
    const uint32_t size = std::bit_floor(std::clamp(wanted, 32u, 1024u));
    return light.kind == LightKind::kPoint ? std::max(size / 2, 32u) : size;
}

LightView faceView(const RenderLight& light, uint32_t face, const RenderScene& scene,
                   const RsmSettings& settings) {
    const float far = farDistanceOf(light, scene.bounds);
    if (light.kind == LightKind::kDirectional)
        return sunView(light.direction, scene.bounds, settings.sunMargin);
    if (light.kind == LightKind::kSpot) return spotView(light, settings.nearDistance, far);
    return cubeFaceView(light.position, face, settings.nearDistance, far);
}

io::RsmMap mapOf(const RenderLight& light) {
    return {.position = light.position,
            .kind = uint32_t(light.kind),
            .direction = light.direction,
            .range = light.range,
            .intensity = light.intensity,
            .cosInner = std::cos(light.innerConeAngle),
            .cosOuter = std::cos(light.outerConeAngle),
            .lightIdLow = uint32_t(light.id)};
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

// Shares by flux, in steps of 8 so that small changes of flux move nothing; the first maps keep what is left
// over.
void shareClusters(RsmLayout& layout, std::span<const float> flux, uint32_t budget) {
    float total = 0;
    for (float f : flux)
        total += f;
    uint32_t next = 0;
    for (uint32_t m = 0; m < layout.mapCount; ++m) {
        const uint32_t reserved = (layout.mapCount - 1 - m) * kMinClustersPerMap;
        const uint32_t most = std::max(budget - std::min(budget, next + reserved), 1u);
        const float share = total > 0 ? flux[m] / total : 1.0f / float(layout.mapCount);
        const uint32_t rounded = uint32_t(std::lround(share * float(budget) / 8.0f)) * 8;
        io::RsmMap& map = layout.maps[m];
        map.firstCluster = next;
        map.clusterCount =
            layout.mapCount == 1 ? budget : std::clamp(rounded, std::min(kMinClustersPerMap, most), most);
        next += map.clusterCount;
        if (map.kind == io::kMapOfSurfaces) {  // neighbours in space may lie anywhere in it
            map.clusterCount = std::min(map.clusterCount, io::kMaxCandidates);
            map.candidateRadius = layout.faces[map.firstFace].size / io::kRsmTileSize;
            continue;
        }
        const float side = float(layout.faces[map.firstFace].size) * std::sqrt(float(map.faceCount));
        const float cell = side / std::sqrt(float(map.clusterCount));
        map.candidateRadius = std::max(1u, uint32_t(std::ceil(2.0f * cell / float(io::kRsmTileSize))));
    }
}

// Returns the weight that gives it its share.
float addSurfaceMap(RsmLayout& layout, std::span<const float> flux, uint32_t side, float share) {
    float total = 0;
    for (const float f : flux.first(layout.mapCount))
        total += f;
    io::RsmMap& map = layout.maps[layout.mapCount];
    map = {.kind = io::kMapOfSurfaces,
           .direction = {0, -1, 0},
           .intensity = glm::vec3(std::max(total, 1e-20f)),  // a texel's part of it is much
           .tanHalf = 0.5f,
           .firstFace = layout.faceCount,
           .faceCount = 1,
           .lightIdLow = ~0u};
    layout.faces[layout.faceCount++] = {
        .worldFromClip = glm::mat4(1), .clipFromWorld = glm::mat4(1), .size = side, .map = layout.mapCount};
    layout.largestFace = std::max(layout.largestFace, side);
    return total * share / std::max(1 - share, 0.01f);
}

}  // namespace

float emittedFlux(const RenderLight& light, const Bounds& sceneBounds) {
    const float mean = (light.intensity.x + light.intensity.y + light.intensity.z) / 3;
    if (light.kind == LightKind::kPoint) return mean * 4 * std::numbers::pi_v<float>;
    if (light.kind == LightKind::kSpot) {
        const float cosine = std::cos(0.5f * (light.innerConeAngle + light.outerConeAngle));
        return mean * 2 * std::numbers::pi_v<float> * (1 - cosine);
    }
    const float half = sunView(light.direction, sceneBounds, 0).tanHalf;
    return mean * 4 * half * half;
}

RsmLayout layoutRsm(const RenderScene& scene, const RsmSettings& settings, uint32_t clusterBudget,
                    uint32_t surfaceSide, float surfaceShare) {
    RsmLayout layout;
    std::array<float, io::kMaxRsmMaps> flux{};
    for (const RenderLight& light : scene.lights) {
        const bool dark = light.intensity == glm::vec3(0);
        if (!light.bounces || dark || layout.mapCount == io::kMaxBounceLights) continue;
        io::RsmMap& map = layout.maps[layout.mapCount] = mapOf(light);
        map.firstFace = layout.faceCount;
        map.faceCount = facesOf(light);
        for (uint32_t f = 0; f < map.faceCount; ++f) {
            const LightView view = faceView(light, f, scene, settings);
            map.tanHalf = view.tanHalf;
            io::RsmFace& face = layout.faces[layout.faceCount++];
            face.clipFromWorld = view.clipFromWorld;
            face.worldFromClip = glm::mat4(glm::inverse(glm::dmat4(view.clipFromWorld)));
            face.size = faceSize(light, settings);
            face.map = layout.mapCount;
            layout.largestFace = std::max(layout.largestFace, face.size);
        }
        flux[layout.mapCount++] = emittedFlux(light, scene.bounds) * light.budgetShare;
    }
    if (layout.mapCount == 0) return layout;
    if (surfaceSide > 0) flux[layout.mapCount] = addSurfaceMap(layout, flux, surfaceSide, surfaceShare);
    layout.mapCount += surfaceSide > 0;
    placeFaces(layout);
    shareClusters(layout, {flux.data(), layout.mapCount}, clusterBudget);
    return layout;
}

}  // namespace ag::gi
