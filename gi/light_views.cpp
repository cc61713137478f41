#include "gi/light_views.h"

#include <algorithm>
#include <cmath>

#include "engine/scene/projection.h"

namespace ag::gi {

glm::mat4 viewFromWorld(glm::vec3 position, glm::vec3 forward) {
    const glm::vec3 up = std::abs(forward.y) > 0.99f ? glm::vec3(0, 0, 1) : glm::vec3(0, 1, 0);
    const glm::vec3 right = glm::normalize(glm::cross(forward, up));
    const glm::vec3 top = glm::cross(right, forward);
    glm::mat4 m(1);
    for (int i = 0; i < 3; ++i)
        m[i] = glm::vec4(right[i], top[i], -forward[i], 0);
    m[3] = glm::vec4(-glm::dot(right, position), -glm::dot(top, position), glm::dot(forward, position), 1);
    return m;
}

LightView spotView(const RenderLight& light, float nearDistance, float farDistance) {
    const float halfAngle = std::min(light.outerConeAngle, glm::radians(80.0f));
    const glm::mat4 clipFromView = lightPerspective(2 * halfAngle, nearDistance, farDistance);
    return {clipFromView * viewFromWorld(light.position, light.direction), std::tan(halfAngle)};
}

LightView cubeFaceView(glm::vec3 position, uint32_t face, float nearDistance, float farDistance) {
    glm::vec3 forward(0);
    forward[int(face / 2)] = face % 2 == 0 ? 1.0f : -1.0f;
    const glm::mat4 clipFromView = lightPerspective(glm::radians(90.0f), nearDistance, farDistance);
    return {clipFromView * viewFromWorld(position, forward), 1.0f};
}

LightView sunView(glm::vec3 direction, const Bounds& bounds, float margin) {
    const glm::mat4 rotation = viewFromWorld(glm::vec3(0), direction);
    Bounds seen;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 p(corner & 1 ? bounds.max.x : bounds.min.x, corner & 2 ? bounds.max.y : bounds.min.y,
                          corner & 4 ? bounds.max.z : bounds.min.z);
        seen.add(glm::vec3(rotation * glm::vec4(p, 1)));
    }
    const glm::vec3 center = (seen.min + seen.max) * 0.5f, extent = seen.max - seen.min;
    const float half = std::max({extent.x, extent.y, 1e-3f}) * 0.5f * (1 + margin);
    const float depth = std::max(extent.z, 1e-3f) * (0.5f + margin);
    // Eye at the near side of the box, looking along the light.
    const glm::vec3 eye =
        glm::vec3(glm::transpose(rotation) * glm::vec4(center.x, center.y, center.z + depth, 0));
    return {lightOrtho(2 * half, 0.0f, 2 * depth) * viewFromWorld(eye, direction), half};
}

float farDistanceOf(const RenderLight& light, const Bounds& bounds) {
    if (light.range > 0) return light.range;
    const glm::vec3 far =
        glm::max(glm::abs(bounds.min - light.position), glm::abs(bounds.max - light.position));
    return std::max(glm::length(far) * 1.01f, 1.0f);
}

}  // namespace ag::gi
