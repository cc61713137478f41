// Points on each mesh, chosen once: what an instance of it that comes later is stood for by.
#pragma once

#include <vector>

#include "engine/scene/render_scene.h"
#include "gi/surface_sampling.h"

namespace ag::render {

struct MeshPoints {
    std::vector<io::SurfaceSample> samples;  // along a curve over the mesh, of instance 0
    std::vector<glm::vec2> uvs;              // parallel
    std::vector<glm::vec3> tints;
    float area = 0;  // m², one side, as it was modelled
    // Of these samples, once asked for; NaN: not yet. See PointPool.
    std::vector<glm::vec3> albedos;
};

// At most so many of a mesh, and about so many in all.
constexpr uint32_t kMostMeshPoints = 1024, kLeastMeshPoints = 16, kAllMeshPoints = 1u << 17;

// Of every primitive; none of those that are alpha-blended.
std::vector<MeshPoints> sampleMeshes(const GeometryArrays& geometry);

}  // namespace ag::render
