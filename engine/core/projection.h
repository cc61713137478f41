// Clip matrices with reversed depth (near 1, far 0) and y pointing down, as Vulkan's viewport has it.
#pragma once

#include <glm/glm.hpp>

namespace ag {

// Infinite far plane; depth = near / distance along the axis. fovY in radians, near in m.
glm::mat4 reversedInfinitePerspective(float fovY, float aspect, float near);
// Square, finite.
glm::mat4 lightPerspective(float fov, float near, float far);
// A rectangle of `size` m.
glm::mat4 lightOrtho(glm::vec2 size, float near, float far);

}  // namespace ag
