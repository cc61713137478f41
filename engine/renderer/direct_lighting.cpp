#include "engine/renderer/direct_lighting.h"

#include <array>

#include "engine/renderer/scene_draws.h"
#include "gi/occluder_trees.h"
#include "shaders/bvh/bvh_io.h"
#include "shaders/direct_lighting/direct_lighting_io.h"

namespace ag::render {
namespace {

// Pass names are literals, because the graph keeps views of them.
constexpr std::array<std::string_view, kMostSuns> kPassNames = {
    "direct_lighting.sun0", "direct_lighting.sun1", "direct_lighting.sun2", "direct_lighting.sun3"};

}  // namespace

void bindDirectLight(GraphScope scope, const gi::Surfaces& gbuffer, bool glossy, PassBuilder& pass,
                     DirectLight& light) {
    const bool first = !light.image, lobes = glossy && gbuffer.reflectance;
    const ImageInfo info{.format = VK_FORMAT_R16G16B16A16_SFLOAT, .size = gbuffer.size};
    if (first) light.image = scope.image("direct_lighting.irradiance", info);
    if (first && lobes) light.highlights = scope.image("direct_lighting.highlights", info);
    // Compiled out, bindings take any image of the same class.
    const ImageHandle highlights = lobes ? light.highlights : light.image;
    pass.constant("kFirst", first)
        .constant("kGlossy", lobes)
        .sample("albedoMap", lobes ? gbuffer.albedo : gbuffer.normal)
        .sample("reflectanceMap", lobes ? gbuffer.reflectance : gbuffer.normal);
    if (first) {
        pass.write("irradiance", light.image).write("highlights", highlights);
    } else {
        pass.readWrite("irradiance", light.image).readWrite("highlights", highlights);
    }
}

io::RayOffsets shadowRayOffsets(const gi::Occluders& traced) {
    return {.least = traced.rayOffset, .ofPixel = traced.trees.snapping};
}

void readShadowTrees(PassBuilder& pass, const SceneView& scene, const gi::TracedOccluders& trees) {
    gi::readTrees(pass, trees);
    // Compiled out where nothing is masked.
    pass.read("treeMasks", trees.masks ? trees.masks : trees.triangles).constant("kMasks", bool(trees.masks));
    bindBaseColors(pass, scene, Sampler::kNearestClamp);
}

DirectLight addSunLighting(GraphScope scope, const SceneView& scene, const gi::Surfaces& gbuffer,
                           const ShadowMaps& shadows, const gi::Occluders* traced, bool glossy) {
    DirectLight result;
    for (uint32_t i = 0; i < shadows.sunCount; ++i) {
        const RenderLight& light = scene.scene->lights[shadows.suns[i].light];
        const bool shadow = shadows.suns[i].viewCount > 0;
        const std::string_view shadowed =
            traced ? "direct_lighting/add_sun_traced.comp" : "direct_lighting/add_sun_shadowed.comp";
        PassBuilder pass =
            scope.compute(kPassNames[i], shadow ? shadowed : "direct_lighting/add_sun_unshadowed.comp");
        pass.sample("normalMap", gbuffer.normal)
            .sample("depthMap", gbuffer.depth)
            .read("camera", scene.camera)
            .push(io::Sun{.direction = light.direction,
                          .firstView = shadows.suns[i].firstView,
                          .irradiance = light.intensity,
                          .viewCount = shadows.suns[i].viewCount,
                          .offsets = traced ? shadowRayOffsets(*traced) : io::RayOffsets{},
                          .rayReach = gi::kRayReaches * scene.extent})
            .dispatchThreads(gbuffer.size.x, gbuffer.size.y);
        if (shadow && traced)
            readShadowTrees(pass, scene, traced->trees);
        else if (shadow)
            pass.read("shadowViews", shadows.views).sample("shadowAtlas", shadows.atlas);
        bindDirectLight(scope, gbuffer, glossy, pass, result);
    }
    return result;
}

}  // namespace ag::render
