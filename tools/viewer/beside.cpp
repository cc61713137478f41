#include "tools/viewer/beside.h"

#include <cmath>

namespace ag::viewer {

ImageHandle addBeside(GraphScope scope, const render::SceneView& view, const render::RenderFrame& frame,
                      const render::CompositeSettings& composite, const OtherPicture& other,
                      const BesideSettings& settings) {
    const render::RenderOutputs& ours = frame.outputs;
    const glm::uvec2 size = scope.info(ours.display).size;
    if (scope.info(other.radiance).size != size) return ours.display;
    const ImageHandle out = scope.image("viewer.beside", {.format = VK_FORMAT_R8G8B8A8_UNORM, .size = size});
    const BesideShown show = other.mean > 0 ? settings.show : BesideShown::kPicture;
    const float unit = view.units.light;
    struct Push {
        float exposure;
        uint32_t mode, show;
        float split, otherUnit, otherMean;
    };
    scope.fullscreen("viewer.beside", "debug_view/beside.frag")
        .sample("oursDisplay", ours.display)
        .sample("oursRadiance", ours.radiance)
        .sample("otherRadiance", other.radiance)
        .read("metered", ours.exposure ? ours.exposure : view.camera)  // unread where by hand
        .constant("kMetered", bool(ours.exposure))
        .push(Push{std::exp2(composite.exposure) * unit, uint32_t(composite.tonemap), uint32_t(show),
                   settings.split * float(size.x), other.unit / unit, other.mean / unit})
        .colorClear(out, glm::vec4(0));
    return out;
}

}  // namespace ag::viewer
