#include "gi/pixel_rays.h"

namespace ag::gi {

io::PixelRays pixelRays(const RenderCamera& camera, glm::uvec2 size) {
    const auto rayAt = [&](glm::uvec2 pixel) {
        const glm::vec2 ndc = (glm::vec2(pixel) + 0.5f) / glm::vec2(size) * 2.0f - 1.0f;
        const glm::vec4 h = camera.worldFromClip * glm::vec4(ndc, 1, 1);
        const glm::vec3 ray = glm::vec3(h) / h.w - camera.position;
        return ray / glm::dot(ray, camera.forward);
    };
    const glm::uvec2 last = glm::max(size, 2u) - 1u;
    const glm::vec3 corner = rayAt({0, 0});
    return {.eye = camera.position,
            .corner = corner,
            .right = (rayAt({last.x, 0}) - corner) / float(last.x),
            .down = (rayAt({0, last.y}) - corner) / float(last.y)};
}

BufferHandle addReprojectionCameras(GraphScope scope, std::string_view name, const RenderCamera& now,
                                    const RenderCamera& before, glm::uvec2 size) {
    const io::PixelRays rays = pixelRays(now, size);
    const io::ReprojectionCameras cameras{.previousClipFromWorld = before.clipFromWorld,
                                          .now = rays,
                                          .before = pixelRays(before, size),
                                          .pixelSize = glm::length(rays.down)};
    const BufferHandle buffer = scope.buffer(name, {.sizeBytes = sizeof cameras});
    scope.upload(name, buffer, std::as_bytes(std::span(&cameras, 1)));
    return buffer;
}

}  // namespace ag::gi
