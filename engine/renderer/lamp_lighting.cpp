#include "engine/renderer/lamp_lighting.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace ag::render {
namespace {

constexpr uint32_t kFewClusters = 4;  // shadows at every pixel cost no more than the detour for so few

// What every pass over the lists needs.
PassBuilder beginShading(GraphScope scope, std::string_view name, std::string_view shader,
                         const SceneView& scene, const gi::Surfaces& gbuffer, const LampLists& l) {
    PassBuilder pass = scope.compute(name, shader);
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
        .spec(1, shadows.softTaps)
        .spec(2, std::bit_cast<uint32_t>(settings.shadowReach));
}

struct LampQuads {  // at one pixel of each 2 x 2, W/m²
    ImageHandle shadowed, unshadowed;
};

LampQuads addLampQuads(GraphScope scope, const SceneView& scene, const gi::Surfaces& gbuffer,
                       const LampLists& l, const LampShadows& shadows, const LampLightingSettings& settings) {
    const ImageInfo desc{.format = VK_FORMAT_R16G16B16A16_SFLOAT, .size = (gbuffer.size + 1u) / 2u};
    const LampQuads quads{.shadowed = scope.image("lamp_lighting.shadowed", desc),
                          .unshadowed = scope.image("lamp_lighting.unshadowed", desc)};
    PassBuilder pass = beginShading(scope, "lamp_lighting.shadow", "direct_lighting/shade_lamp_quads.comp",
                                    scene, gbuffer, l);
    bindShadows(pass, shadows, settings);
    pass.write("shadowed", quads.shadowed)
        .write("unshadowed", quads.unshadowed)
        .dispatchGroups(l.tiles.x * l.tiles.y);
    return quads;
}

}  // namespace

gi::Irradiance addLampLighting(GraphScope scope, const SceneView& scene, const gi::Surfaces& gbuffer,
                               const LampLists& lists, const LampShadows& shadows, gi::Irradiance before,
                               const LampLightingSettings& settings) {
    if (!lists.lamps) return before;
    const bool shadowed = bool(shadows.atlas);
    const bool quads = shadowed && settings.quads && shadows.places > kFewClusters;
    const gi::Irradiance result{
        before.image ? before.image
                     : scope.image("lamp_lighting.irradiance",
                                   {.format = VK_FORMAT_R16G16B16A16_SFLOAT, .size = gbuffer.size})};
    const LampQuads from =
        quads ? addLampQuads(scope, scene, gbuffer, lists, shadows, settings) : LampQuads{};
    PassBuilder shade = beginShading(scope, "lamp_lighting.shade",
                                     quads      ? "direct_lighting/spread_lamp_shadows.comp"
                                     : shadowed ? "direct_lighting/shade_lamps.comp"
                                                : "direct_lighting/shade_lamps_unshadowed.comp",
                                     scene, gbuffer, lists);
    shade.spec(0, !before.image);
    shade.dispatchGroups(lists.tiles.x * lists.tiles.y);
    if (quads) shade.sample("shadowed", from.shadowed).sample("unshadowed", from.unshadowed);
    if (shadowed && !quads) bindShadows(shade, shadows, settings);
    if (before.image)
        shade.readWrite("irradiance", result.image);
    else
        shade.write("irradiance", result.image);
    return result;
}

}  // namespace ag::render
