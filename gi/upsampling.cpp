#include "gi/upsampling.h"

#include "gi/pixel_rays.h"
#include "shaders/upsampling/upsampling_io.h"

namespace ag::gi {

Irradiance addUpsampling(FrameGraph& graph, const SceneView& scene, const GBuffer& gbuffer,
                         const Irradiance& gathered) {
    if (!gathered.image || gathered.step == 1) return gathered;
    const RenderCamera& camera = scene.scene->camera;
    const io::PixelRays rays = pixelRays(camera, gbuffer.size);
    const io::UpsamplingPush push{.rays = rays,
                                  .footprint = 2 * float(gathered.step) * glm::length(rays.down),
                                  .near = camera.near,
                                  .step = gathered.step};
    const ImageHandle result =
        graph.image("upsampling.irradiance", {.format = VK_FORMAT_R16G16B16A16_SFLOAT, .size = gbuffer.size});
    const uint64_t pixels = uint64_t(gbuffer.size.x) * gbuffer.size.y;
    const BufferHandle lacking =
        graph.buffer("upsampling.lacking", {.sizeBytes = (1 + pixels) * sizeof(uint32_t)});
    graph.fill("upsampling.none_lacking", lacking, 0);
    const BufferHandle groups =
        graph.buffer("upsampling.groups", {.sizeBytes = sizeof(glm::uvec3), .indirect = true});
    const glm::uvec3 none(0, 1, 1);
    graph.upload("upsampling.no_groups", groups, std::as_bytes(std::span(&none, 1)));
    graph.compute("upsampling.near", "upsampling/upsample.comp")
        .sample("normalMap", gbuffer.normal)
        .sample("depthMap", gbuffer.depth)
        .sample("light", gathered.image)
        .readWrite("lacking", lacking)
        .readWrite("groups", groups)
        .write("result", result)
        .push(push)
        .dispatchThreads(gbuffer.size.x, gbuffer.size.y);
    graph.compute("upsampling.far", "upsampling/upsample_lacking.comp")
        .sample("normalMap", gbuffer.normal)
        .sample("depthMap", gbuffer.depth)
        .sample("light", gathered.image)
        .read("lacking", lacking)
        .readWrite("result", result)
        .push(push)
        .dispatchIndirect(groups);
    return {.image = result, .coat = gathered.coat};
}

}  // namespace ag::gi
