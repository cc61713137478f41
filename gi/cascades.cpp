#include "gi/cascades.h"

#include <algorithm>
#include <cmath>

#include "engine/scene/projection.h"

namespace ag::gi {
namespace {

struct Sphere {
    glm::vec3 center;
    float radius;
};

// The smallest sphere on the camera's axis round a slice of its frustum; the radius does not change as it
// turns.
Sphere sliceSphere(const RenderCamera& camera, float aspect, float near, float far) {
    const float tanY = std::tan(camera.verticalFov * 0.5f), tanX = tanY * aspect;
    const float k = tanX * tanX + tanY * tanY;
    const float along = std::min(0.5f * (near + far) * (1 + k), far);
    const float radius = std::sqrt((far - along) * (far - along) + k * far * far);
    return {camera.position + camera.forward * along, std::max(radius, 1e-3f)};
}

}  // namespace

float cascadeEnd(uint32_t index, uint32_t count, float near, float far, float logShare) {
    const float t = float(index + 1) / float(count);
    const float uniform = near + (far - near) * t;
    const float logarithmic = near * std::pow(far / near, t);
    return glm::mix(uniform, logarithmic, logShare);
}

Cascade fitCascade(const RenderCamera& camera, float aspect, glm::vec3 sunDirection, const Bounds& casters,
                   float sliceNear, float sliceFar, uint32_t resolution) {
    const Sphere sphere = sliceSphere(camera, aspect, sliceNear, sliceFar);
    // Radius in coarse steps, so that a field of view that breathes does not change the texel size.
    const float radius = std::ceil(sphere.radius * 16.0f) / 16.0f;
    const float texel = 2 * radius / float(resolution);
    const glm::mat4 rotation = viewFromWorld(glm::vec3(0), sunDirection);
    glm::vec3 center = glm::vec3(rotation * glm::vec4(sphere.center, 1));
    center.x = std::floor(center.x / texel) * texel;
    center.y = std::floor(center.y / texel) * texel;

    float highest = -1e30f, lowest = 1e30f;  // of the casters along the light's axis (z grows toward the sun)
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 p(corner & 1 ? casters.max.x : casters.min.x,
                          corner & 2 ? casters.max.y : casters.min.y,
                          corner & 4 ? casters.max.z : casters.min.z);
        const float z = (rotation * glm::vec4(p, 1)).z;
        highest = std::max(highest, z);
        lowest = std::min(lowest, z);
    }
    const float depth = std::max(highest - lowest, 1e-2f) * 1.02f;
    const glm::vec3 eye =
        glm::vec3(glm::transpose(rotation) * glm::vec4(center.x, center.y, highest + 0.01f * depth, 0));
    return {.clipFromWorld = lightOrtho(2 * radius, 0.0f, depth) * viewFromWorld(eye, sunDirection),
            .width = 2 * radius,
            .depth = depth,
            .farDistance = sliceFar};
}

}  // namespace ag::gi
