#include "engine/renderer/punctual_lighting.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "gi/occluder_trees.h"

namespace ag::render {
namespace {

constexpr uint32_t kFewClusters = 4;  // shadows at every pixel cost no more than the detour for so few

// What every pass over the lists needs.
PassBuilder beginShading(GraphScope scope, std::string_view name, std::string_view shader,
                         const SceneView& scene, const gi::Surfaces& gbuffer, const PunctualLists& l) {
    PassBuilder pass = scope.compute(name, shader);
    pass.sample("normalMap", gbuffer.normal)
        .sample("depthMap", gbuffer.depth)
        .read("camera", scene.camera)
        .read("lights", l.lights)
        .read("lists", l.lists)
        .read("counts", l.counts);
    return pass;
}

void bindShadows(PassBuilder& pass, const PunctualShadows& shadows,
                 const PunctualLightingSettings& settings) {
    pass.read("clusters", shadows.clusters)
        .sample("shadowAtlas", shadows.atlas)
        .constant("kSoftTaps", shadows.softTaps)
        .constant("kShadowReach", settings.shadowReach);
}

struct PunctualQuads {  // at one pixel of each 2 x 2, W/m²
    ImageHandle shadowed, unshadowed;
};

PunctualQuads addPunctualQuads(GraphScope scope, const SceneView& scene, const gi::Surfaces& gbuffer,
                               const PunctualLights& lights, const PunctualLightingSettings& settings) {
    const ImageInfo desc{.format = VK_FORMAT_R16G16B16A16_SFLOAT, .size = (gbuffer.size + 1u) / 2u};
    const PunctualQuads quads{.shadowed = scope.image("punctual_lighting.shadowed", desc),
                              .unshadowed = scope.image("punctual_lighting.unshadowed", desc)};
    PassBuilder pass =
        beginShading(scope, "punctual_lighting.shadow", "direct_lighting/shade_punctual_quads.comp", scene,
                     gbuffer, lights.lists);
    bindShadows(pass, lights.shadows, settings);
    pass.write("shadowed", quads.shadowed)
        .write("unshadowed", quads.unshadowed)
        .dispatchGroups(lights.lists.tiles.x * lights.lists.tiles.y);
    return quads;
}

}  // namespace

DirectLight addPunctualLighting(GraphScope scope, const SceneView& scene, const gi::Surfaces& gbuffer,
                                const PunctualLights& lights, DirectLight before, const gi::Occluders* traced,
                                bool glossy, const PunctualLightingSettings& settings) {
    const auto& [lists, shadows] = lights;
    if (!lists.lights) return before;
    const bool shadowed = bool(shadows.atlas);
    const bool rays = shadowed && traced;
    const bool quads = shadowed && settings.quads && shadows.places > kFewClusters && !rays;
    const PunctualQuads from =
        quads ? addPunctualQuads(scope, scene, gbuffer, lights, settings) : PunctualQuads{};
    PassBuilder shade = beginShading(scope, "punctual_lighting.shade",
                                     quads      ? "direct_lighting/spread_punctual_shadows.comp"
                                     : rays     ? "direct_lighting/shade_punctual_traced.comp"
                                     : shadowed ? "direct_lighting/shade_punctual.comp"
                                                : "direct_lighting/shade_punctual_unshadowed.comp",
                                     scene, gbuffer, lists);
    shade.dispatchGroups(lists.tiles.x * lists.tiles.y);
    if (quads) shade.sample("shadowed", from.shadowed).sample("unshadowed", from.unshadowed);
    if (shadowed && !quads) bindShadows(shade, shadows, settings);
    if (rays) {
        shade.push(shadowRayOffsets(*traced));
        readShadowTrees(shade, scene, traced->trees);
    }
    bindDirectLight(scope, gbuffer, glossy, shade, before);
    return before;
}

}  // namespace ag::render
