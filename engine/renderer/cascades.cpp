#include "engine/renderer/cascades.h"

#include <algorithm>
#include <cmath>

#include "engine/core/projection.h"

namespace ag::render {
namespace {

struct Sphere {
    glm::vec3 center;
    float radius;
};

// The smallest sphere on the camera's axis round the slice; the radius does not change as it turns.
Sphere sphereRound(const FrustumSlice& slice) {
    const auto& [camera, aspect, near, far] = slice;
    const float tanY = std::tan(camera.verticalFov * 0.5f), tanX = tanY * aspect;
    const float k = tanX * tanX + tanY * tanY;
    const float along = std::min(0.5f * (near + far) * (1 + k), far);
    const float radius = std::sqrt((far - along) * (far - along) + k * far * far);
    return {camera.position + camera.forward * along, std::max(radius, 1e-3f)};
}

// A sixteenth of the power of two below, in parts of `extent`.
float coarseStep(float length, float extent) {
    return extent * std::exp2(std::floor(std::log2(std::max(length / extent, 1e-6f)))) / 16.0f;
}

float coarse(float length, float extent) {
    const float step = coarseStep(length, extent);
    return std::ceil(length / step) * step;
}

}  // namespace

float cascadeEnd(uint32_t index, uint32_t count, float near, float far, float logShare) {
    const float t = float(index + 1) / float(count);
    const float uniform = near + (far - near) * t;
    const float logarithmic = near * std::pow(far / near, t);
    return glm::mix(uniform, logarithmic, logShare);
}

Cascade fitCascade(const FrustumSlice& slice, glm::vec3 sunDirection, const Bounds& casters, float extent,
                   uint32_t resolution) {
    const Sphere sphere = sphereRound(slice);
    const gi::SunRectangle scene = gi::sunRectangle(sunDirection, casters, 0);
    const glm::vec3 center = glm::vec3(scene.rotation * glm::vec4(sphere.center, 1));
    glm::vec2 size, middle;
    for (int i = 0; i < 2; ++i) {
        // Sizes in coarse steps, so that neither a breathing field of view nor a thing that moves at the
        // scene's edge changes that of a texel.
        const float whole = coarse((scene.seen.max[i] - scene.seen.min[i]) * 1.02f, extent);
        size[i] = std::min(coarse(2 * sphere.radius, extent), whole);
        const float texel = size[i] / float(resolution), slack = 0.5f * (whole - size[i]);
        const float grid = coarseStep(whole, extent) / 8;
        const float sceneMiddle = std::floor((scene.seen.min[i] + scene.seen.max[i]) * 0.5f / grid) * grid;
        const float aside = std::clamp(center[i] - sceneMiddle, -slack, slack);
        middle[i] = std::floor((sceneMiddle + aside) / texel) * texel;
    }
    const float depth = std::max(scene.seen.max.z - scene.seen.min.z, 1e-2f) * 1.02f;
    const glm::vec3 eye =
        glm::vec3(glm::transpose(scene.rotation) * glm::vec4(middle, scene.seen.max.z + 0.01f * depth, 0));
    return {.clipFromWorld = lightOrtho(size, 0.0f, depth) * gi::viewFromWorld(eye, sunDirection, scene.up),
            .size = size,
            .farDistance = slice.far};
}

}  // namespace ag::render
