#include "tools/scenegen/shapes.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtx/rotate_vector.hpp>

namespace ag::scenegen {
namespace {

constexpr float kSmoothCosine = 0.766f;

MeshPart& partOf(MeshParts& parts, uint32_t material) {
    for (MeshPart& part : parts)
        if (part.material == material) return part;
    parts.push_back({.material = material});
    return parts.back();
}

uint32_t addVertex(MeshPart& part, glm::vec3 position, glm::vec3 normal) {
    part.positions.push_back(position);
    part.normals.push_back(normal);
    return uint32_t(part.positions.size() - 1);
}

// Triangles that a pole or a tip leaves without area are not there.
void addTriangle(MeshPart& part, uint32_t a, uint32_t b, uint32_t c) {
    const glm::vec3 p = part.positions[a];
    if (glm::length(glm::cross(part.positions[b] - p, part.positions[c] - p)) < 1e-7f) return;
    part.indices.insert(part.indices.end(), {a, b, c});
}

void addQuadIndices(MeshPart& part, uint32_t a, uint32_t b, uint32_t c, uint32_t d) {
    addTriangle(part, a, b, c);
    addTriangle(part, a, c, d);
}

// The outward direction of a profile's piece: (radius, height).
glm::vec2 outward(glm::vec2 a, glm::vec2 b) {
    return glm::normalize(glm::vec2(b.y - a.y, a.x - b.x));
}

}  // namespace

void addBox(MeshParts& parts, uint32_t material, glm::vec3 center, glm::vec3 size, float yaw) {
    MeshPart& part = partOf(parts, material);
    for (int axis = 0; axis < 3; ++axis)
        for (const float side : {-1.0f, 1.0f}) {
            glm::vec3 u(0), v(0), normal(0), middle(0);
            u[(axis + 1) % 3] = size[(axis + 1) % 3] / 2;
            v[(axis + 2) % 3] = size[(axis + 2) % 3] / 2;
            normal[axis] = side;
            middle[axis] = side * size[axis] / 2;
            if (side < 0) std::swap(u, v);
            const auto corner = [&](float a, float b) {
                return addVertex(part, center + glm::rotateY(middle + u * a + v * b, yaw),
                                 glm::rotateY(normal, yaw));
            };
            const uint32_t a = corner(-1, -1), b = corner(1, -1), c = corner(1, 1), d = corner(-1, 1);
            addQuadIndices(part, a, b, c, d);
        }
}

void addLathe(MeshParts& parts, uint32_t material, std::span<const glm::vec2> profile, uint32_t segments,
              glm::vec3 center) {
    MeshPart& part = partOf(parts, material);
    for (size_t i = 0; i + 1 < profile.size(); ++i) {
        const glm::vec2 here = outward(profile[i], profile[i + 1]);
        glm::vec2 ends[2] = {here, here};
        if (i > 0) {
            const glm::vec2 before = outward(profile[i - 1], profile[i]);
            if (glm::dot(before, here) > kSmoothCosine) ends[0] = glm::normalize(before + here);
        }
        if (i + 2 < profile.size()) {
            const glm::vec2 after = outward(profile[i + 1], profile[i + 2]);
            if (glm::dot(after, here) > kSmoothCosine) ends[1] = glm::normalize(after + here);
        }
        const uint32_t first = uint32_t(part.positions.size());
        for (uint32_t s = 0; s <= segments; ++s) {
            const float angle = glm::two_pi<float>() * float(s) / float(segments);
            const glm::vec3 away(std::cos(angle), 0, -std::sin(angle));
            for (int e = 0; e < 2; ++e) {
                const glm::vec2 p = profile[i + size_t(e)];
                addVertex(part, center + away * p.x + glm::vec3(0, p.y, 0),
                          away * ends[e].x + glm::vec3(0, ends[e].y, 0));
            }
        }
        for (uint32_t s = 0; s < segments; ++s)
            addQuadIndices(part, first + 2 * s, first + 2 * s + 2, first + 2 * s + 3, first + 2 * s + 1);
    }
}

void addSheet(MeshParts& parts, uint32_t material, const std::function<glm::vec3(float, float)>& f,
              uint32_t columns, uint32_t rows) {
    MeshPart& part = partOf(parts, material);
    const uint32_t first = uint32_t(part.positions.size());
    constexpr float kStep = 1e-3f;
    for (uint32_t r = 0; r <= rows; ++r)
        for (uint32_t c = 0; c <= columns; ++c) {
            const float u = float(c) / float(columns), v = float(r) / float(rows);
            const glm::vec3 du = f(std::min(u + kStep, 1.0f), v) - f(std::max(u - kStep, 0.0f), v);
            const glm::vec3 dv = f(u, std::min(v + kStep, 1.0f)) - f(u, std::max(v - kStep, 0.0f));
            const glm::vec3 n = glm::cross(du, dv);
            const float length = glm::length(n);
            addVertex(part, f(u, v), length > 1e-12f ? n / length : glm::vec3(0, 1, 0));
        }
    for (uint32_t r = 0; r < rows; ++r)
        for (uint32_t c = 0; c < columns; ++c) {
            const uint32_t a = first + r * (columns + 1) + c;
            addQuadIndices(part, a, a + 1, a + columns + 2, a + columns + 1);
        }
}

}  // namespace ag::scenegen
