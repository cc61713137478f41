// Skinned meshes' vertices on the CPU, by the functions the device runs: for the reference, for choosing
// points on surfaces, for tests.
#pragma once

#include "engine/scene/render_scene.h"

namespace ag {

struct DeformedVertices {  // of all skinned meshes, as RenderSkinnedMesh::firstDeformed counts them
    std::vector<glm::vec3> positions;
    std::vector<VertexAttributes> attributes;
};
DeformedVertices deformSkinnedMeshes(const RenderScene& scene);

struct VertexPointers {  // by the primitive's indices
    const glm::vec3* positions;
    const VertexAttributes* attributes;
};
VertexPointers verticesOf(const RenderScene& scene, const DeformedVertices& deformed,
                          const RenderInstance& instance);

}  // namespace ag
