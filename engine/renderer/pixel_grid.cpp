#include "engine/renderer/pixel_grid.h"

#include <glm/gtc/matrix_transform.hpp>

#include "engine/core/hash.h"

namespace ag::render {

RenderCamera jittered(const RenderCamera& camera, const PixelGrid& grid) {
    if (grid.jitter == glm::vec2(0)) return camera;
    const glm::vec3 shift(-2.0f * grid.jitter / glm::vec2(grid.size), 0);  // clip space is 2 wide
    RenderCamera moved = camera;
    moved.clipFromWorld = glm::translate(glm::mat4(1), shift) * camera.clipFromWorld;
    moved.worldFromClip = camera.worldFromClip * glm::translate(glm::mat4(1), -shift);
    return moved;
}

uint64_t jitteredVersion(uint64_t cameraVersion, const PixelGrid& grid) {
    return grid.jitter == glm::vec2(0) ? cameraVersion : combineHash(cameraVersion, hashValue(grid.jitter));
}

}  // namespace ag::render
