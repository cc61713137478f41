#include "tools/viewer/light_handles.h"

#include <cmath>

namespace ag::viewer {
namespace {

constexpr float kReachPixels = 12;

struct Axes {
    glm::vec3 right, top;
};

Axes axesOf(const CameraPose& pose) {
    const glm::vec3 right = rightOf(pose.forward, pose.up);
    return {right, glm::cross(right, pose.forward)};
}

// Along the view, m.
float depthOf(const CameraPose& pose, glm::dvec3 place) {
    return float(glm::dot(place - pose.position, glm::dvec3(pose.forward)));
}

// Metres of a pixel at a depth of 1 m.
float metresPerPixel(const Screen& s) {
    return 2 * std::tan(s.pose.verticalFov / 2) / s.size.y;
}

}  // namespace

std::optional<glm::vec2> projected(const Screen& s, glm::dvec3 place) {
    const float depth = depthOf(s.pose, place);
    if (depth <= s.pose.near) return std::nullopt;
    const Axes axes = axesOf(s.pose);
    const auto d = glm::vec3(place - s.pose.position);
    const glm::vec2 off(glm::dot(d, axes.right), -glm::dot(d, axes.top));
    return s.size * 0.5f + off / (depth * metresPerPixel(s));
}

glm::dvec3 draggedPlace(const Screen& s, glm::dvec3 place, glm::vec2 pixels) {
    const Axes axes = axesOf(s.pose);
    const float scale = depthOf(s.pose, place) * metresPerPixel(s);
    return place + glm::dvec3((axes.right * pixels.x - axes.top * pixels.y) * scale);
}

std::vector<LightHandle> lightHandles(std::span<const RenderLight> lights, glm::dvec3 origin,
                                      glm::dvec3 focus, float reach) {
    std::vector<LightHandle> handles;
    for (size_t i = 0; i < lights.size(); ++i) {
        const RenderLight& l = lights[i];
        const glm::dvec3 place = origin + glm::dvec3(l.position),
                         along = glm::dvec3(l.direction) * double(reach);
        if (l.kind == LightKind::kDirectional) {
            handles.push_back({i, true, focus - along, focus});
            continue;
        }
        handles.push_back({i, false, place, place});
        if (l.kind == LightKind::kSpot) handles.push_back({i, true, place + along, place});
    }
    return handles;
}

std::optional<size_t> handleAt(const Screen& screen, std::span<const LightHandle> handles, glm::vec2 pixel) {
    std::optional<size_t> best;
    float nearest = kReachPixels;
    for (size_t i = 0; i < handles.size(); ++i) {
        const auto at = projected(screen, handles[i].place);
        if (!at || glm::distance(*at, pixel) > nearest) continue;
        nearest = glm::distance(*at, pixel);
        best = i;
    }
    return best;
}

void moveHandle(const LightHandle& handle, glm::dvec3 place, glm::dvec3 origin, RenderLight& light) {
    if (!handle.aims) {
        light.position = glm::vec3(place - origin);
        return;
    }
    const auto way = glm::vec3(place - handle.anchor);
    if (glm::length(way) < 1e-6f) return;
    const float side = light.kind == LightKind::kDirectional ? -1 : 1;  // a sun shines from its handle
    light.direction = glm::normalize(way) * side;
}

}  // namespace ag::viewer
