#include "gi/upsampling.h"

#include "gi/pixel_rays.h"
#include "shaders/upsampling/upsampling_io.h"

namespace ag::gi {

Irradiance addUpsampling(GraphScope scope, const Surfaces& all, const Surfaces& downsampled,
                         const Irradiance& gathered, const UpsamplingNames& names, const Irradiance& base) {
    const uint32_t spacing = downsampled.spacing / all.spacing;
    if (!gathered.image || spacing == 1) return gathered;
    const io::PixelRays rays = pixelRays(all.view, all.size);
    const io::UpsamplingPush push{.rays = rays,
                                  .footprint = 2 * float(spacing) * glm::length(rays.down),
                                  .near = all.view.near,
                                  .spacing = spacing};
    const ImageHandle result =
        scope.image(names.irradiance, {.format = VK_FORMAT_R16G16B16A16_SFLOAT, .size = all.size});
    const PixelList lacking = addPixelList(scope, names.lacking, all.size);
    const auto addPass = [&](std::string_view name, const char* shader) {
        PassBuilder pass = scope.compute(name, shader);
        pass.sample("normalMap", all.normal)
            .sample("depthMap", all.depth)
            .sample("cellNormals", downsampled.normal)
            .sample("cellDepths", downsampled.depth)
            .sample("light", gathered.image)
            .sample("toward", gathered.toward ? gathered.toward : gathered.image)
            .sample("base", base.image ? base.image : gathered.image)
            .constant("kDirected", bool(gathered.toward))
            .constant("kAdd", bool(base.image))
            .push(push);
        return pass;
    };
    addPass(names.near, "upsampling/upsample.comp")
        .readWrite("listed", lacking.pixels)
        .readWrite("listedGroups", lacking.groups)
        .write("result", result)
        .dispatchThreads(all.size.x, all.size.y);
    addPass(names.far, "upsampling/upsample_lacking.comp")
        .read("lacking", lacking.pixels)
        .readWrite("result", result)
        .dispatchIndirect(lacking.groups);
    return {result, base.toward};
}

}  // namespace ag::gi
