#include "engine/renderer/direct_lighting.h"

#include <array>

#include "shaders/direct_lighting/direct_lighting_io.h"

namespace ag::render {
namespace {

// Pass names are literals, because the graph keeps views of them.
constexpr std::array<std::string_view, kMostSuns> kPassNames = {
    "direct_lighting.sun0", "direct_lighting.sun1", "direct_lighting.sun2", "direct_lighting.sun3"};

}  // namespace

gi::Irradiance addSunLighting(GraphScope scope, const SceneView& scene, const gi::Surfaces& gbuffer,
                              const ShadowMaps& shadows) {
    gi::Irradiance result;
    for (uint32_t i = 0; i < shadows.sunCount; ++i) {
        const RenderLight& light = scene.scene->lights[shadows.suns[i].light];
        const bool first = i == 0, shadow = shadows.suns[i].viewCount > 0;
        if (first)
            result.image = scope.image("direct_lighting.irradiance",
                                       {.format = VK_FORMAT_R16G16B16A16_SFLOAT, .size = gbuffer.size});
        PassBuilder pass = scope.compute(kPassNames[i], shadow ? "direct_lighting/add_sun_shadowed.comp"
                                                               : "direct_lighting/add_sun_unshadowed.comp");
        pass.sample("normalMap", gbuffer.normal)
            .sample("depthMap", gbuffer.depth)
            .read("camera", scene.camera)
            .constant("kFirst", first)
            .push(io::Sun{.direction = light.direction,
                          .firstView = shadows.suns[i].firstView,
                          .irradiance = light.intensity,
                          .viewCount = shadows.suns[i].viewCount})
            .dispatchThreads(gbuffer.size.x, gbuffer.size.y);
        if (shadow) pass.read("shadowViews", shadows.views).sample("shadowAtlas", shadows.atlas);
        if (first)
            pass.write("irradiance", result.image);
        else
            pass.readWrite("irradiance", result.image);
    }
    return result;
}

}  // namespace ag::render
