#include "gi/lamp_lighting.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace ag::gi {
namespace {

constexpr uint32_t kFewClusters = 4;  // shadows at every pixel cost no more than the detour for so few

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
void gatherLamps(const RenderScene& scene, const LightClusters& c, bool shadows, LampLightingHistory& h) {
    h.order.resize(c.lamps.size());
    for (uint32_t i = 0; i < h.order.size(); ++i)
        h.order[i] = i;
    std::ranges::sort(h.order, {}, [&](uint32_t i) { return std::pair(c.clusterOf[i], i); });
    h.lamps.clear();
    for (const uint32_t i : h.order)
        h.lamps.push_back(lampRow(scene, c.lamps[i], c, shadows ? c.clusterOf[i] : io::kNoLampCluster));
}

struct LampLists {  // by tiles
    BufferHandle lamps, lists, counts;
    glm::uvec2 tiles{0};
};

LampLists addLampLists(FrameGraph& graph, const SceneView& scene, const GBuffer& gbuffer, bool byRange,
                       const std::vector<io::Lamp>& rows) {
    LampLists l{.tiles = (gbuffer.size + io::kLampTileSize - 1u) / io::kLampTileSize};
    const uint64_t tileCount = uint64_t(l.tiles.x) * l.tiles.y;
    l.lamps = graph.buffer(
        "lamp_lighting.lamps",
        {.sizeBytes = std::bit_ceil(std::max<size_t>(scene.scene->lights.size(), 64)) * sizeof(io::Lamp),
         .texelFormat = VK_FORMAT_R32G32B32A32_SFLOAT});
    graph.upload("lamp_lighting.lamps", l.lamps, std::as_bytes(std::span(rows)));
    l.lists = graph.buffer("lamp_lighting.lists", {.sizeBytes = tileCount * io::kMaxLampsPerTile * 4,
                                                   .texelFormat = VK_FORMAT_R32_UINT});
    l.counts = graph.buffer("lamp_lighting.counts", {.sizeBytes = tileCount * 4});
    graph.compute("lamp_lighting.list", "direct_lighting/list_lamps.comp")
        .sample("depthMap", gbuffer.depth)
        .read("camera", scene.camera)
        .read("lamps", l.lamps)
        .write("lists", l.lists)
        .write("counts", l.counts)
        .spec(0, byRange)
        .push(io::LampPush{.lampCount = uint32_t(rows.size())})
        .dispatchGroups(uint32_t(tileCount));
    return l;
}

// What every pass over the lists needs.
PassBuilder beginShading(FrameGraph& graph, std::string_view name, std::string_view shader,
                         const SceneView& scene, const GBuffer& gbuffer, const LampLists& l) {
    PassBuilder pass = graph.compute(name, shader);
    pass.sample("normalMap", gbuffer.normal)
        .sample("depthMap", gbuffer.depth)
        .read("camera", scene.camera)
        .read("lamps", l.lamps)
        .read("lists", l.lists)
        .read("counts", l.counts);
    return pass;
}

void bindShadows(PassBuilder& pass, const LampShadows& shadows, const LampLightingSettings& settings) {
    pass.read("clusters", shadows.clusters)
        .sample("shadowAtlas", shadows.atlas)
        .spec(1, settings.softTaps)
        .spec(2, std::bit_cast<uint32_t>(settings.shadowReach));
}

struct LampQuads {  // at one pixel of each 2 x 2, W/m²
    ImageHandle shadowed, unshadowed;
};

LampQuads addLampQuads(FrameGraph& graph, const SceneView& scene, const GBuffer& gbuffer, const LampLists& l,
                       const LampShadows& shadows, const LampLightingSettings& settings) {
    const ImageInfo desc{.format = VK_FORMAT_R16G16B16A16_SFLOAT, .size = (gbuffer.size + 1u) / 2u};
    const LampQuads quads{.shadowed = graph.image("lamp_lighting.shadowed", desc),
                          .unshadowed = graph.image("lamp_lighting.unshadowed", desc)};
    PassBuilder pass = beginShading(graph, "lamp_lighting.shadow", "direct_lighting/shade_lamp_quads.comp",
                                    scene, gbuffer, l);
    bindShadows(pass, shadows, settings);
    pass.write("shadowed", quads.shadowed)
        .write("unshadowed", quads.unshadowed)
        .dispatchGroups(l.tiles.x, l.tiles.y);
    return quads;
}

}  // namespace

Irradiance addLampLighting(FrameGraph& graph, const SceneView& scene, const GBuffer& gbuffer,
                           BufferHandle viewPoints, const LightClusters& clusters, const LampShadows& shadows,
                           Irradiance before, const LampLightingSettings& settings,
                           LampLightingHistory& history) {
    if (clusters.lamps.empty()) return before;
    const bool shadowed = bool(shadows.atlas);
    const bool quads = shadowed && settings.quads && shadows.places > kFewClusters;
    gatherLamps(*scene.scene, clusters, shadowed, history);
    const LampLists lists = addLampLists(graph, scene, gbuffer, settings.tiles, history.lamps);
    const Irradiance result{
        before.image ? before.image
                     : graph.image("lamp_lighting.irradiance",
                                   {.format = VK_FORMAT_R16G16B16A16_SFLOAT, .size = gbuffer.size})};
    const LampQuads from =
        quads ? addLampQuads(graph, scene, gbuffer, lists, shadows, settings) : LampQuads{};
    PassBuilder shade = beginShading(graph, "lamp_lighting.shade",
                                     quads      ? "direct_lighting/spread_lamp_shadows.comp"
                                     : shadowed ? "direct_lighting/shade_lamps.comp"
                                                : "direct_lighting/shade_lamps_unshadowed.comp",
                                     scene, gbuffer, lists);
    shade.spec(0, !before.image);
    if (quads)
        shade.sample("shadowed", from.shadowed)
            .sample("unshadowed", from.unshadowed)
            .dispatchGroups(lists.tiles.x * lists.tiles.y);
    else
        shade.dispatchGroups(lists.tiles.x, lists.tiles.y);
    if (shadowed && !quads) bindShadows(shade, shadows, settings);
    if (before.image)
        shade.readWrite("irradiance", result.image);
    else
        shade.write("irradiance", result.image);
    if (shadowed)
        addLampRelevance(graph, viewPoints, lists.lamps, uint32_t(history.lamps.size()), history.relevance);
    return result;
}

}  // namespace ag::gi
