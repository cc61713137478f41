#include "gi/ray_filter.h"

#include "gi/pixel_rays.h"
#include "shaders/ray_filter/ray_filter_io.h"

namespace ag::gi {

ImageHandle addJoinedTurns(GraphScope scope, const Surfaces& all, ImageHandle placed, float tolerance,
                           const JoinNames& names) {
    const ImageHandle result =
        scope.image(names.result, {.format = VK_FORMAT_R16G16B16A16_SFLOAT, .size = all.size});
    scope.compute(names.pass, "ray_filter/join.comp")
        .sample("normalMap", all.normal)
        .sample("depthMap", all.depth)
        .sample("light", placed)
        .write("result", result)
        .push(io::JoinPush{pixelRays(all.view, all.size), all.view.near, {1, tolerance}})
        .dispatchThreads(all.size.x, all.size.y);
    return result;
}

}  // namespace ag::gi
