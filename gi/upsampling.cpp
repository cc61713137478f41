#include "gi/upsampling.h"

#include "gi/pixel_rays.h"
#include "shaders/upsampling/upsampling_io.h"

namespace ag::gi {

Irradiance addUpsampling(FrameGraph& graph, const GBuffer& all, const GBuffer& thin,
                         const Irradiance& gathered, const UpsamplingNames& names) {
    if (!gathered.image || thin.spacing == 1) return gathered;
    const io::PixelRays rays = pixelRays(all.view, all.size);
    const io::UpsamplingPush push{.rays = rays,
                                  .footprint = 2 * float(thin.spacing) * glm::length(rays.down),
                                  .near = all.view.near,
                                  .spacing = thin.spacing};
    const ImageHandle result =
        graph.image(names.irradiance, {.format = VK_FORMAT_R16G16B16A16_SFLOAT, .size = all.size});
    const uint64_t pixels = uint64_t(all.size.x) * all.size.y;
    const BufferHandle lacking = graph.buffer(names.lacking, {.sizeBytes = (1 + pixels) * sizeof(uint32_t)});
    graph.fill(names.noneLacking, lacking, 0);
    const BufferHandle groups =
        graph.buffer(names.groups, {.sizeBytes = sizeof(glm::uvec3), .indirect = true});
    const glm::uvec3 none(0, 1, 1);
    graph.upload(names.noGroups, groups, std::as_bytes(std::span(&none, 1)));
    const auto addPass = [&](std::string_view name, const char* shader) {
        PassBuilder pass = graph.compute(name, shader);
        pass.sample("normalMap", all.normal)
            .sample("depthMap", all.depth)
            .sample("cellNormals", thin.normal)
            .sample("cellDepths", thin.depth)
            .sample("light", gathered.image)
            .push(push);
        return pass;
    };
    addPass(names.near, "upsampling/upsample.comp")
        .readWrite("lacking", lacking)
        .readWrite("groups", groups)
        .write("result", result)
        .dispatchThreads(all.size.x, all.size.y);
    addPass(names.far, "upsampling/upsample_lacking.comp")
        .read("lacking", lacking)
        .readWrite("result", result)
        .dispatchIndirect(groups);
    return {result, gathered.coat};
}

}  // namespace ag::gi
