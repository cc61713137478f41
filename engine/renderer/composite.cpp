#include "engine/renderer/composite.h"

#include <cmath>

#include "gi/pixel_rays.h"

namespace ag::render {

ImageHandle addRadiance(GraphScope scope, const GBuffer& gbuffer, const CompositeLight& light,
                        Behind behind) {
    const gi::Surfaces& surfaces = gbuffer.surfaces;
    const ImageHandle radiance =
        scope.image("composite.radiance", {.format = VK_FORMAT_R16G16B16A16_SFLOAT, .size = surfaces.size});

    // A term that is not there is compiled out; its binding takes any image of the same class.
    const auto orAlbedo = [&](ImageHandle image) { return image ? image : surfaces.albedo; };
    scope.fullscreen("composite.combine", "composite/combine.frag")
        .sample("albedoMap", surfaces.albedo)
        .sample("directMap", orAlbedo(light.direct.image))
        .sample("highlightMap", orAlbedo(light.direct.highlights))
        .sample("skyMap", orAlbedo(light.sky.image))
        .sample("skyGlossMap", orAlbedo(light.sky.gloss))
        .sample("reflectanceMap", orAlbedo(surfaces.reflectance))
        .sample("skyPicture", orAlbedo(light.scene.skyPicture), Sampler::kLinearRepeat)
        .sample("indirectMap", orAlbedo(light.bounce.irradiance.image))
        .sample("emissiveMap", orAlbedo(gbuffer.emissive))
        .sample("specularMap", orAlbedo(light.bounce.gloss))
        .sample("depthMap", surfaces.depth)
        .constant("kDirect", bool(light.direct.image))
        .constant("kIndirect", bool(light.bounce.irradiance.image))
        .constant("kHighlights", bool(light.direct.highlights))
        .constant("kSky", bool(light.sky.image))
        .constant("kSkyGloss", bool(light.sky.gloss))
        .constant("kSkyPicture", light.scene.skyPicture && behind == Behind::kSky)
        .constant("kEmissive", bool(gbuffer.emissive))
        .constant("kSpecular", bool(light.bounce.gloss))
        .push(gi::pixelRays(surfaces.view, surfaces.size))
        .colorClear(radiance, glm::vec4(0));
    return radiance;
}

ImageHandle addDisplay(GraphScope scope, const GBuffer& gbuffer, ImageHandle radiance, BufferHandle exposure,
                       const CompositeSettings& settings) {
    const ImageHandle display = scope.image(
        "composite.display", {.format = VK_FORMAT_R8G8B8A8_UNORM, .size = scope.info(radiance).size});
    scope.fullscreen("composite.tonemap", "composite/tonemap.frag")
        .sample("radianceMap", radiance)
        .read("metered", exposure ? exposure : gbuffer.surfaces.camera)  // unread where by hand
        .constant("kMetered", bool(exposure))
        .constant("kCurve", uint32_t(settings.tonemap))
        .constant("kDither", settings.dither)
        .push(std::exp2(settings.exposure))
        .colorClear(display, glm::vec4(0));
    return display;
}

}  // namespace ag::render
