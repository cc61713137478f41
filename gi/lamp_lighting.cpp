#include "gi/lamp_lighting.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace ag::gi {
namespace {

constexpr float kNoCone = -2;

io::Lamp lampRow(const RenderLight& light, uint32_t cluster) {
    const bool spot = light.kind == LightKind::kSpot;
    return {.position = light.position,
            .range = light.range,
            .intensity = light.intensity,
            .cluster = cluster,
            .direction = light.direction,
            .cosInner = std::cos(light.innerConeAngle),
            .cosOuter = spot ? std::cos(light.outerConeAngle) : kNoCone};
}

// Cluster by cluster; those without a shadow come last.
void gatherLamps(const RenderScene& scene, const LightClusters& c, bool shadows, LampLightingHistory& h) {
    h.order.resize(c.lamps.size());
    for (uint32_t i = 0; i < h.order.size(); ++i)
        h.order[i] = i;
    std::ranges::sort(h.order, {}, [&](uint32_t i) { return std::pair(c.clusterOf[i], i); });
    h.lamps.clear();
    for (const uint32_t i : h.order)
        h.lamps.push_back(lampRow(scene.lights[c.lamps[i]], shadows ? c.clusterOf[i] : io::kNoLampCluster));
}

}  // namespace

Irradiance addLampLighting(FrameGraph& graph, const SceneView& scene, const GBuffer& gbuffer,
                           const LightClusters& clusters, const LampShadows& shadows, Irradiance before,
                           const LampLightingSettings& settings, LampLightingHistory& history) {
    if (clusters.lamps.empty()) return before;
    const bool shadowed = bool(shadows.atlas);
    gatherLamps(*scene.scene, clusters, shadowed, history);
    const std::span<const std::byte> rows = std::as_bytes(std::span(history.lamps));
    const BufferHandle lamps = graph.buffer(
        "lamp_lighting.lamps",
        {.sizeBytes = std::bit_ceil(std::max<size_t>(scene.scene->lights.size(), 64)) * sizeof(io::Lamp),
         .texelFormat = VK_FORMAT_R32G32B32A32_SFLOAT});
    graph.upload("lamp_lighting.lamps", lamps, rows);
    const glm::uvec2 tiles = (gbuffer.size + io::kLampTileSize - 1u) / io::kLampTileSize;
    const uint64_t tileCount = uint64_t(tiles.x) * tiles.y;
    const BufferHandle lists =
        graph.buffer("lamp_lighting.lists",
                     {.sizeBytes = tileCount * io::kMaxLampsPerTile * 4, .texelFormat = VK_FORMAT_R32_UINT});
    const BufferHandle counts = graph.buffer("lamp_lighting.counts", {.sizeBytes = tileCount * 4});
    graph.compute("lamp_lighting.list", "direct_lighting/list_lamps.comp")
        .sample("depthMap", gbuffer.depth)
        .read("camera", scene.camera)
        .read("lamps", lamps)
        .write("lists", lists)
        .write("counts", counts)
        .spec(0, settings.tiles)
        .push(io::LampPush{.lampCount = uint32_t(history.lamps.size())})
        .dispatchGroups(uint32_t(tileCount));

    const Irradiance result{
        before.image ? before.image
                     : graph.image("lamp_lighting.irradiance",
                                   {.format = VK_FORMAT_R16G16B16A16_SFLOAT, .size = gbuffer.size})};
    PassBuilder shade =
        graph.compute("lamp_lighting.shade", shadowed ? "direct_lighting/shade_lamps.comp"
                                                      : "direct_lighting/shade_lamps_unshadowed.comp");
    shade.sample("normalMap", gbuffer.normal)
        .sample("depthMap", gbuffer.depth)
        .read("camera", scene.camera)
        .read("lamps", lamps)
        .read("lists", lists)
        .read("counts", counts)
        .spec(0, !before.image)
        .spec(1, settings.softTaps)
        .dispatchGroups(tiles.x, tiles.y);
    if (shadowed) shade.read("clusters", shadows.clusters).sample("shadowAtlas", shadows.atlas);
    if (before.image)
        shade.readWrite("irradiance", result.image);
    else
        shade.write("irradiance", result.image);
    return result;
}

}  // namespace ag::gi
