#include "gi/surfaces.h"

#include "shaders/gbuffer/view_points_io.h"
#include "shaders/scene/scene_io.h"

namespace ag::gi {
namespace {

// Of pixels c spacing + place: their centres are those of an image of `size` / spacing pixels.
RenderCamera downsampled(const RenderCamera& camera, glm::uvec2 size, const Downsampling& by) {
    const glm::vec2 all(size), downsampled(glm::max(size / by.spacing, 1u) * by.spacing);
    // Pixels, of the chosen ones from the squares' middles.
    const glm::vec2 aside = glm::vec2(by.place) + 0.5f - float(by.spacing) / 2;
    const glm::vec2 scale = downsampled / all, shift = scale + 2.0f * aside / all - 1.0f;
    glm::mat4 fullFromDownsampled(1), downsampledFromFull(1);
    for (int i = 0; i < 2; ++i) {
        fullFromDownsampled[i][i] = scale[i], fullFromDownsampled[3][i] = shift[i];
        downsampledFromFull[i][i] = 1 / scale[i], downsampledFromFull[3][i] = -shift[i] / scale[i];
    }
    RenderCamera out = camera;
    out.clipFromWorld = downsampledFromFull * camera.clipFromWorld;
    out.worldFromClip = camera.worldFromClip * fullFromDownsampled;
    return out;
}

glm::ivec3 pushOf(const Downsampling& by) {
    return {glm::ivec2(by.place), int32_t(by.spacing)};
}

}  // namespace

BufferHandle addCamera(GraphScope scope, std::string_view name, const RenderCamera& camera, glm::uvec2 size) {
    const io::CameraConstants constants{.clipFromWorld = camera.clipFromWorld,
                                        .worldFromClip = camera.worldFromClip,
                                        .position = camera.position,
                                        .near = camera.near,
                                        .size = size};
    const BufferHandle buffer = scope.buffer(name, {.sizeBytes = sizeof constants});
    scope.upload(name, buffer, std::as_bytes(std::span(&constants, 1)));
    return buffer;
}

Surfaces addDownsampled(GraphScope scope, const Surfaces& all, const Downsampling& by,
                        const DownsamplingNames& names) {
    if (by.spacing == 1) return all;
    const glm::uvec2 size = glm::max(all.size / by.spacing, 1u);
    Surfaces g{
        .depth = scope.image(names.depth, {.format = VK_FORMAT_R32_SFLOAT, .size = size}),
        .normal = addDownsampledImage(scope, names.normal, all.normal, by),
        .motion = addDownsampledImage(scope, names.motion, all.motion, by),
        .size = size,
        .normalMapped = all.normalMapped,
        .spacing = all.spacing * by.spacing,
        .place = by.place,
        .view = downsampled(all.view, all.size, by),
    };
    g.camera = addCamera(scope, names.camera, g.view, size);
    scope.compute(names.depth, "gbuffer/downsample_depth.comp")
        .sample("all", all.depth)
        .write("downsampled", g.depth)
        .push(pushOf(by))
        .dispatchThreads(size.x, size.y);
    return g;
}

ImageHandle addDownsampledImage(GraphScope scope, std::string_view name, ImageHandle all,
                                const Downsampling& by) {
    if (!all || by.spacing == 1) return all;
    const glm::uvec2 size = glm::max(scope.info(all).size / by.spacing, 1u);
    const ImageHandle downsampled =
        scope.image(name, {.format = VK_FORMAT_R16G16B16A16_SFLOAT, .size = size});
    scope.compute(name, "gbuffer/downsample_image.comp")
        .sample("all", all)
        .write("downsampled", downsampled)
        .push(pushOf(by))
        .dispatchThreads(size.x, size.y);
    return downsampled;
}

BufferHandle addViewPoints(GraphScope scope, const Surfaces& surfaces) {
    const BufferHandle points =
        scope.buffer("gbuffer.view_points", {.sizeBytes = io::kViewPointCount * sizeof(io::ViewPoint),
                                             .texelFormat = VK_FORMAT_R32G32B32A32_SFLOAT});
    scope.compute("gbuffer.sample_view", "gbuffer/sample_view.comp")
        .sample("normalMap", surfaces.normal)
        .sample("depthMap", surfaces.depth)
        .read("camera", surfaces.camera)
        .write("viewPoints", points)
        .dispatchThreads(io::kViewPointCount);
    return points;
}

}  // namespace ag::gi
