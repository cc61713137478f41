#include "engine/core/projection.h"

#include <cmath>

namespace ag {

glm::mat4 reversedInfinitePerspective(float fovY, float aspect, float near) {
    const float f = 1 / std::tan(fovY * 0.5f);
    glm::mat4 m(0);
    m[0][0] = f / aspect;
    m[1][1] = -f;
    m[2][3] = -1;
    m[3][2] = near;
    return m;
}

glm::mat4 lightPerspective(float fov, float near, float far) {
    const float f = 1 / std::tan(fov * 0.5f);
    glm::mat4 m(0);
    m[0][0] = f;
    m[1][1] = -f;
    m[2][2] = near / (far - near);
    m[2][3] = -1;
    m[3][2] = near * far / (far - near);
    return m;
}

glm::mat4 lightOrtho(glm::vec2 size, float near, float far) {
    glm::mat4 m(1);
    m[0][0] = 2 / size.x;
    m[1][1] = -2 / size.y;
    m[2][2] = 1 / (far - near);
    m[3][2] = far / (far - near);
    return m;
}

}  // namespace ag
