#include "tools/viewer/picking.h"

#include <algorithm>
#include <cmath>

namespace ag::viewer {
namespace {

constexpr float kNoHit = 1e30f;

// In an instance's frame; distances are those of the world, for the direction keeps its length there.
struct Ray {
    glm::vec3 from, along;
};

// Whether the box is met nearer than `nearest`, and where. A ray along two of its planes is between them all
// the way, or nowhere.
std::optional<float> meetsBox(const Bounds& box, const Ray& ray, float nearest) {
    float begin = 0, end = nearest;
    for (int c = 0; c < 3; ++c) {
        const float low = box.min[c] - ray.from[c], high = box.max[c] - ray.from[c];
        if (ray.along[c] == 0) {
            if (low > 0 || high < 0) return std::nullopt;
            continue;
        }
        const float a = low / ray.along[c], b = high / ray.along[c];
        begin = std::max(begin, std::min(a, b));
        end = std::min(end, std::max(a, b));
    }
    return begin <= end ? std::optional(begin) : std::nullopt;
}

// Möller and Trumbore 1997, both sides; `nearest` if it is not met before.
float meetsTriangle(const Ray& ray, glm::vec3 a, glm::vec3 b, glm::vec3 c, float nearest) {
    const glm::vec3 u = b - a, v = c - a, p = glm::cross(ray.along, v);
    const float determinant = glm::dot(u, p);
    if (determinant == 0) return nearest;
    const glm::vec3 s = (ray.from - a) / determinant, q = glm::cross(s, u);
    const float x = glm::dot(s, p), y = glm::dot(ray.along, q), t = glm::dot(v, q);
    const bool inside = x >= 0 && y >= 0 && x + y <= 1;
    return inside && t > 0 && t < nearest ? t : nearest;
}

float meets(const RenderScene& scene, const RenderInstance& instance, const Ray& ray, float nearest) {
    const auto box = meetsBox(boundsLocal(scene, instance), ray, nearest);
    if (!box) return nearest;
    if (instance.skinnedMesh != kNoSkinnedMesh) return *box;
    const GeometryArrays& g = *scene.geometry;
    const Primitive& p = g.primitives[instance.primitive];
    const auto corner = [&](uint32_t i) {
        return g.positions[size_t(p.vertexOffset + int32_t(g.indices[p.firstIndex + i]))];
    };
    for (uint32_t i = 0; i + 2 < p.indexCount; i += 3)
        nearest = meetsTriangle(ray, corner(i), corner(i + 1), corner(i + 2), nearest);
    return nearest;
}

}  // namespace

glm::vec3 rayThrough(const Screen& s, glm::vec2 pixel) {
    // Any depth will do: the point under the pixel, one metre ahead.
    const glm::dvec3 ahead = s.pose.position + glm::dvec3(s.pose.forward);
    return glm::normalize(glm::vec3(draggedPlace(s, ahead, pixel - s.size * 0.5f) - s.pose.position));
}

std::optional<Picked> pick(const RenderScene& scene, glm::vec3 eye, glm::vec3 direction) {
    Picked best{.distance = kNoHit};
    for (uint32_t i = 0; i < scene.instances.size(); ++i) {
        const glm::mat4x3& m = scene.instances[i].worldFromLocal;
        const glm::mat3 linear(m);
        if (!scene.instances[i].isPresent() || glm::determinant(linear) == 0) continue;
        const glm::mat3 back = glm::inverse(linear);
        const float at =
            meets(scene, scene.instances[i], {back * (eye - m[3]), back * direction}, best.distance);
        if (at < best.distance) best = {i, at};
    }
    return best.distance < kNoHit ? std::optional(best) : std::nullopt;
}

}  // namespace ag::viewer
