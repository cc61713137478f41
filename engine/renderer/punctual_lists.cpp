#include "engine/renderer/punctual_lists.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace ag::render {
namespace {

io::PunctualLight punctualLightRow(const RenderScene& scene, uint32_t index, const LightClusters& c,
                                   uint32_t cluster) {
    const RenderLight& light = scene.lights[index];
    io::PunctualLight row{.position = light.position,
                          .inverseRange2 = light.range > 0 ? 1 / (light.range * light.range) : 0,
                          .intensity = light.intensity,
                          .cluster = cluster,
                          .axis = glm::vec3(0),
                          .coneOffset = 1,
                          .id = {uint32_t(light.id), uint32_t(light.id >> 32)}};
    if (light.kind == LightKind::kSpot) {
        const float inner = std::cos(light.innerConeAngle), outer = std::cos(light.outerConeAngle);
        const float scale = 1 / std::max(inner - outer, 1e-4f);
        row.axis = -scale * light.direction;
        row.coneOffset = -scale * outer;
    }
    if (cluster != io::kNoLightCluster)
        row.clusterDistance =
            glm::distance(light.position, scene.lights[c.clusters[cluster].center].position);
    return row;
}

// Cluster by cluster; those without a shadow come last.
void gatherLights(const RenderScene& scene, const LightClusters& c, PunctualListsHistory& h) {
    h.order.resize(c.lights.size());
    for (uint32_t i = 0; i < h.order.size(); ++i)
        h.order[i] = i;
    std::ranges::sort(h.order, {}, [&](uint32_t i) { return std::pair(c.clusterOf[i], i); });
    h.lights.clear();
    for (const uint32_t i : h.order)
        h.lights.push_back(punctualLightRow(scene, c.lights[i], c, c.clusterOf[i]));
}

}  // namespace

PunctualLists addPunctualLists(GraphScope scope, const SceneView& scene, const gi::Surfaces& gbuffer,
                               const LightClusters& clusters, bool byRange, PunctualListsHistory& history) {
    if (clusters.lights.empty()) return {};
    gatherLights(*scene.scene, clusters, history);
    PunctualLists l{.lightCount = uint32_t(history.lights.size()),
                    .tiles = (gbuffer.size + io::kPunctualTileSize - 1u) / io::kPunctualTileSize};
    const uint64_t tileCount = uint64_t(l.tiles.x) * l.tiles.y;
    l.lights = scope.buffer(
        "punctual_lists.lights",
        {.sizeBytes = std::bit_ceil(std::clamp<size_t>(scene.scene->lights.size(), 64, kMostPunctualLights)) *
                      sizeof(io::PunctualLight),
         .texelFormat = VK_FORMAT_R32G32B32A32_SFLOAT});
    scope.upload("punctual_lists.lights", l.lights, std::as_bytes(std::span(history.lights)));
    l.lists = scope.buffer(
        "punctual_lists.lists",
        {.sizeBytes = tileCount * io::kMaxPunctualLightsPerTile * 4, .texelFormat = VK_FORMAT_R32_UINT});
    l.counts = scope.buffer("punctual_lists.counts", {.sizeBytes = tileCount * 4});
    scope.compute("punctual_lists.list", "direct_lighting/list_punctual.comp")
        .sample("depthMap", gbuffer.depth)
        .read("camera", scene.camera)
        .read("lights", l.lights)
        .write("lists", l.lists)
        .write("counts", l.counts)
        .spec(0, byRange)
        .push(io::PunctualPush{.lightCount = l.lightCount})
        .dispatchGroups(uint32_t(tileCount));
    return l;
}

}  // namespace ag::render
