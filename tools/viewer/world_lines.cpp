#include "tools/viewer/world_lines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "shaders/common/sampling.h"

namespace ag::viewer {
namespace {

// A clip position's place; of one without an end, `reach` on from the near plane's `before`.
glm::vec3 farPlace(glm::vec4 v, glm::vec3 before, float reach) {
    const float least = 1e-9f * glm::length(v);
    const glm::vec3 way = std::abs(v.w) > least ? glm::vec3(v) / v.w - before : glm::vec3(v);
    const float length = glm::length(way);
    if (length == 0) return before;
    return before + way * (std::abs(v.w) > least ? std::min(1.0f, reach / length) : reach / length);
}

// Of a box or a frustum, by corners whose indices' bits are their sides.
std::vector<Line> edgesBetween(const std::array<glm::vec3, 8>& corners) {
    std::vector<Line> edges;
    for (size_t i = 0; i < 8; ++i)
        for (const size_t axis : {1u, 2u, 4u})
            if (!(i & axis)) edges.push_back({corners[i], corners[i | axis]});
    return edges;
}

// As the renderer's spot views: any two axes across will do for a picture of it.
std::vector<Line> edgesOfSpot(const io::LightClusterRow& c, float reach) {
    glm::vec3 across, up;
    io::orthonormalBasis(c.direction, across, up);
    const float end = std::min(c.farDistance > 0 ? c.farDistance : reach, reach);
    std::array<glm::vec3, 8> corners;
    for (size_t i = 0; i < 8; ++i) {
        const float depth = i & 4 ? end : c.nearDistance, side = depth * c.tanHalf;
        corners[i] =
            c.center + c.direction * depth + across * (i & 1 ? side : -side) + up * (i & 2 ? side : -side);
    }
    return edgesBetween(corners);
}

}  // namespace

std::vector<Line> linesOf(const io::Val& light, const io::ValShapeVectors& shape) {
    std::vector<Line> lines;
    if (light.flux.x + light.flux.y + light.flux.z <= 0) return lines;
    glm::vec3 t, b;
    io::orthonormalBasis(light.normal, t, b);
    const auto corner = [&](size_t i) {
        const glm::vec2 c = shape.corners[i % io::kValCorners];
        return light.position + t * c.x + b * c.y;
    };
    for (size_t i = 0; i < io::kValCorners; ++i)
        if (corner(i) != corner(i + 1)) lines.push_back({corner(i), corner(i + 1)});
    const float radius = std::sqrt(light.area / std::numbers::pi_v<float>);  // of a disk as large
    lines.push_back({light.position, light.position + light.normal * (radius / 2)});
    return lines;
}

std::vector<Line> edgesOfView(const glm::mat4& clipFromWorld, float reach) {
    const glm::mat4 worldFromClip = glm::inverse(clipFromWorld);
    std::array<glm::vec3, 8> corners;
    for (size_t i = 0; i < 4; ++i) {
        const glm::vec2 side(i & 1 ? 1 : -1, i & 2 ? 1 : -1);
        const glm::vec4 near = worldFromClip * glm::vec4(side, 1, 1);
        corners[i] = glm::vec3(near) / near.w;
        corners[i + 4] = farPlace(worldFromClip * glm::vec4(side, 0, 1), corners[i], reach);
    }
    return edgesBetween(corners);
}

std::vector<Line> edgesOfMap(const io::LightClusterRow& c, float reach) {
    if (c.direction != glm::vec3(0)) return edgesOfSpot(c, reach);
    constexpr float kCube = 0.02f;  // of the reach: it has no end of its own
    const float half = std::max(c.nearDistance, kCube * reach);
    std::array<glm::vec3, 8> corners;
    for (size_t i = 0; i < 8; ++i)
        corners[i] = c.center + half * glm::vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
    return edgesBetween(corners);
}

std::optional<Segment> projectedLine(const Screen& screen, glm::dvec3 from, glm::dvec3 to) {
    const auto depth = [&](glm::dvec3 place) {
        return glm::dot(place - screen.pose.position, glm::dvec3(screen.pose.forward));
    };
    const double least = 1.001 * double(screen.pose.near), a = depth(from), b = depth(to);
    if (a < least && b < least) return std::nullopt;
    if (a < least) from = glm::mix(from, to, (least - a) / (b - a));
    if (b < least) to = glm::mix(to, from, (least - b) / (a - b));
    const auto first = projected(screen, from), second = projected(screen, to);
    return first && second ? std::optional(Segment{*first, *second}) : std::nullopt;
}

}  // namespace ag::viewer
