// A camera as renderers see it: matrices in single precision about an origin near by.
#pragma once

#include <glm/glm.hpp>

namespace ag {

struct RenderCamera {
    glm::mat4 clipFromWorld{1};  // reversed depth, infinite far plane; relative to the origin
    glm::mat4 worldFromClip{1};
    glm::vec3 position{0};  // relative to the origin
    glm::vec3 forward{0, 0, -1};
    glm::vec3 up{0, 1, 0};     // of the picture, at right angles to `forward`
    float verticalFov = 0.8f;  // radians
    float near = 0.05f;        // m
};

}  // namespace ag
