#include "engine/renderer/lamp_lists.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace ag::render {
namespace {

io::Lamp lampRow(const RenderScene& scene, uint32_t index, const LightClusters& c, uint32_t cluster) {
    const RenderLight& light = scene.lights[index];
    io::Lamp row{.position = light.position,
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
    if (cluster != io::kNoLampCluster)
        row.clusterDistance =
            glm::distance(light.position, scene.lights[c.clusters[cluster].center].position);
    return row;
}

// Cluster by cluster; those without a shadow come last.
void gatherLamps(const RenderScene& scene, const LightClusters& c, LampListsHistory& h) {
    h.order.resize(c.lamps.size());
    for (uint32_t i = 0; i < h.order.size(); ++i)
        h.order[i] = i;
    std::ranges::sort(h.order, {}, [&](uint32_t i) { return std::pair(c.clusterOf[i], i); });
    h.lamps.clear();
    for (const uint32_t i : h.order)
        h.lamps.push_back(lampRow(scene, c.lamps[i], c, c.clusterOf[i]));
}

}  // namespace

LampLists addLampLists(GraphScope scope, const SceneView& scene, const gi::Surfaces& gbuffer,
                       const LightClusters& clusters, bool byRange, LampListsHistory& history) {
    if (clusters.lamps.empty()) return {};
    gatherLamps(*scene.scene, clusters, history);
    LampLists l{.lampCount = uint32_t(history.lamps.size()),
                .tiles = (gbuffer.size + io::kLampTileSize - 1u) / io::kLampTileSize};
    const uint64_t tileCount = uint64_t(l.tiles.x) * l.tiles.y;
    l.lamps = scope.buffer(
        "lamp_lists.lamps",
        {.sizeBytes =
             std::bit_ceil(std::clamp<size_t>(scene.scene->lights.size(), 64, kMostLamps)) * sizeof(io::Lamp),
         .texelFormat = VK_FORMAT_R32G32B32A32_SFLOAT});
    scope.upload("lamp_lists.lamps", l.lamps, std::as_bytes(std::span(history.lamps)));
    l.lists = scope.buffer("lamp_lists.lists", {.sizeBytes = tileCount * io::kMaxLampsPerTile * 4,
                                                .texelFormat = VK_FORMAT_R32_UINT});
    l.counts = scope.buffer("lamp_lists.counts", {.sizeBytes = tileCount * 4});
    scope.compute("lamp_lists.list", "direct_lighting/list_lamps.comp")
        .sample("depthMap", gbuffer.depth)
        .read("camera", scene.camera)
        .read("lamps", l.lamps)
        .write("lists", l.lists)
        .write("counts", l.counts)
        .spec(0, byRange)
        .push(io::LampPush{.lampCount = l.lampCount})
        .dispatchGroups(uint32_t(tileCount));
    return l;
}

}  // namespace ag::render
