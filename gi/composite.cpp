#include "gi/composite.h"

#include <cmath>

namespace ag::gi {

GiOutputs addComposite(GraphScope scope, const GBuffer& gbuffer, const Irradiance& direct,
                       const Irradiance& indirect, ImageHandle coat, const CompositeSettings& settings) {
    GiOutputs out;
    out.radiance =
        scope.image("composite.radiance", {.format = VK_FORMAT_R16G16B16A16_SFLOAT, .size = gbuffer.size});
    out.display =
        scope.image("composite.display", {.format = VK_FORMAT_R8G8B8A8_UNORM, .size = gbuffer.size});

    // A term that is not there is compiled out; its binding takes any image of the same class.
    const auto orAlbedo = [&](ImageHandle image) { return image ? image : gbuffer.albedo; };
    scope.fullscreen("composite.combine", "composite/combine.frag")
        .sample("albedoMap", gbuffer.albedo)
        .sample("directMap", orAlbedo(direct.image))
        .sample("indirectMap", orAlbedo(indirect.image))
        .sample("emissiveMap", orAlbedo(gbuffer.emissive))
        .sample("coatMap", orAlbedo(coat))
        .sample("depthMap", gbuffer.depth)
        .spec(0, bool(direct.image))
        .spec(1, bool(indirect.image))
        .spec(2, bool(gbuffer.emissive))
        .spec(3, bool(coat))
        .colorClear(out.radiance, glm::vec4(0));

    struct Push {
        float exposure;
        uint32_t mode;
    };
    scope.fullscreen("composite.tonemap", "composite/tonemap.frag")
        .sample("radianceMap", out.radiance)
        .push(Push{std::exp2(settings.exposure), uint32_t(settings.tonemap)})
        .colorClear(out.display, glm::vec4(0));
    return out;
}

}  // namespace ag::gi
