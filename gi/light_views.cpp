#include "gi/light_views.h"

#include <algorithm>
#include <cmath>

#include "engine/core/projection.h"

namespace ag::gi {

namespace {

// Off the world's axes, which walls follow: a row of texels along an edge would be on one side of it as a
// whole.
constexpr float kAskew = 0.06f;

// What a view along the z axis sees of a box.
Bounds seenBounds(const glm::mat4& view, const Bounds& bounds) {
    Bounds seen;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 p(corner & 1 ? bounds.max.x : bounds.min.x, corner & 2 ? bounds.max.y : bounds.min.y,
                          corner & 4 ? bounds.max.z : bounds.min.z);
        seen.add(glm::vec3(view * glm::vec4(p, 1)));
    }
    return seen;
}

}  // namespace

glm::mat4 viewFromWorld(glm::vec3 position, glm::vec3 forward, glm::vec3 up) {
    const glm::vec3 right = glm::normalize(glm::cross(forward, up));
    const glm::vec3 top = glm::cross(right, forward);
    glm::mat4 m(1);
    for (int i = 0; i < 3; ++i)
        m[i] = glm::vec4(right[i], top[i], -forward[i], 0);
    m[3] = glm::vec4(-glm::dot(right, position), -glm::dot(top, position), glm::dot(forward, position), 1);
    return m;
}

glm::mat4 viewFromWorld(glm::vec3 position, glm::vec3 forward) {
    const glm::vec3 up = std::abs(forward.y) > 0.99f ? glm::vec3(0, 0, 1) : glm::vec3(0, 1, 0);
    return viewFromWorld(position, forward, up);
}

SunRectangle sunRectangle(glm::vec3 direction, const Bounds& bounds, float askew) {
    SunRectangle best;
    for (int axis = 0; axis < 3; ++axis) {
        glm::vec3 up(0);
        up[axis] = 1;
        if (std::abs(direction[axis]) > 0.99f) continue;
        up[(axis + 1) % 3] = askew, up[(axis + 2) % 3] = -askew;
        const glm::mat4 rotation = viewFromWorld(glm::vec3(0), direction, up);
        const Bounds seen = seenBounds(rotation, bounds);
        const glm::vec3 extent = seen.max - seen.min, old = best.seen.max - best.seen.min;
        if (best.up == glm::vec3(0) || extent.x * extent.y < old.x * old.y * 0.99f)
            best = {up, rotation, seen};
    }
    return best;
}

LightView spotView(glm::vec3 position, glm::vec3 direction, float outerConeAngle, float farDistance) {
    const float halfAngle = std::min(outerConeAngle, glm::radians(80.0f));
    const glm::mat4 clipFromView = lightPerspective(2 * halfAngle, kNearOfFar * farDistance, farDistance);
    return {clipFromView * viewFromWorld(position, direction), std::tan(halfAngle)};
}

LightView cubeFaceView(glm::vec3 position, uint32_t face, float farDistance) {
    glm::vec3 forward(0);
    forward[int(face / 2)] = face % 2 == 0 ? 1.0f : -1.0f;
    const glm::mat4 clipFromView =
        lightPerspective(glm::radians(90.0f), kNearOfFar * farDistance, farDistance);
    return {clipFromView * viewFromWorld(position, forward), 1.0f};
}

LightView sunView(glm::vec3 direction, const Bounds& bounds, float margin) {
    const SunRectangle fit = sunRectangle(direction, bounds, kAskew);
    const glm::vec3 center = (fit.seen.min + fit.seen.max) * 0.5f;
    const glm::vec3 extent = glm::max(fit.seen.max - fit.seen.min, glm::vec3(1e-3f));
    const glm::vec2 side = glm::vec2(extent) * (1 + margin);
    const float depth = extent.z * (0.5f + margin);
    // Eye at the near side of the box, looking along the light.
    const glm::vec3 eye =
        glm::vec3(glm::transpose(fit.rotation) * glm::vec4(center.x, center.y, center.z + depth, 0));
    return {lightOrtho(side, 0.0f, 2 * depth) * viewFromWorld(eye, direction, fit.up),
            0.5f * std::sqrt(side.x * side.y)};
}

Frustum frustumOf(const glm::mat4& clipFromWorld, float leastDepth) {
    const glm::mat4 t = glm::transpose(clipFromWorld), worldFromClip = glm::inverse(clipFromWorld);
    Frustum f;
    f.planes = {t[3] + t[0], t[3] - t[0], t[3] + t[1], t[3] - t[1], t[3] - t[2], t[2] - leastDepth * t[3]};
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec4 h = worldFromClip * glm::vec4(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1,
                                                      corner & 4 ? 1.0f : leastDepth, 1);
        f.corners[size_t(corner)] = glm::vec3(h) / h.w;
    }
    return f;
}

bool mayMeet(const Frustum& a, const Frustum& b) {
    const auto apart = [](const Frustum& f, const Frustum& other) {
        return std::ranges::any_of(f.planes, [&](const glm::vec4& plane) {
            return std::ranges::all_of(
                other.corners, [&](glm::vec3 c) { return glm::dot(glm::vec3(plane), c) + plane.w < 0; });
        });
    };
    return !apart(a, b) && !apart(b, a);
}

bool mayMeet(const Frustum& f, const Bounds& box) {
    return std::ranges::none_of(f.planes, [&](const glm::vec4& plane) {
        const glm::vec3 innermost(plane.x > 0 ? box.max.x : box.min.x, plane.y > 0 ? box.max.y : box.min.y,
                                  plane.z > 0 ? box.max.z : box.min.z);
        return glm::dot(glm::vec3(plane), innermost) + plane.w < 0;
    });
}

float farDistanceOf(glm::vec3 position, float range, const Bounds& bounds) {
    if (range > 0) return range;
    const glm::vec3 far = glm::max(glm::abs(bounds.min - position), glm::abs(bounds.max - position));
    return std::max(glm::length(far) * 1.01f, 1.0f);
}

}  // namespace ag::gi
