// Meshes out of boxes, turned profiles and bent sheets, for things that are more than boxes.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace ag::scenegen {

// Triangles by material.
struct MeshPart {
    uint32_t material = 0;
    std::vector<glm::vec3> positions, normals;
    std::vector<uint32_t> indices;
};
using MeshParts = std::vector<MeshPart>;

void addBox(MeshParts& parts, uint32_t material, glm::vec3 center, glm::vec3 size, float yaw = 0);
// A profile of (radius, height) from bottom to top, turned about the upright axis through `center`. Corners
// sharper than 40° stay corners.
void addLathe(MeshParts& parts, uint32_t material, std::span<const glm::vec2> profile, uint32_t segments,
              glm::vec3 center);
// f(u, v) for u, v in [0, 1]; its front looks along df/du x df/dv.
void addSheet(MeshParts& parts, uint32_t material, const std::function<glm::vec3(float, float)>& f,
              uint32_t columns, uint32_t rows);

}  // namespace ag::scenegen
