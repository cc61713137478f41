#include "engine/scene/deform.h"

#include "common/skinning.h"

namespace ag {
namespace {

io::SkinMatrix rowsOf(const glm::mat3x4& joint) {
    return {joint[0], joint[1], joint[2]};
}

void deform(const RenderScene& scene, const RenderSkinnedMesh& skinnedMesh, DeformedVertices& out) {
    const GeometryArrays& g = *scene.geometry;
    const glm::mat3x4* joints = scene.joints.data() + skinnedMesh.firstJoint;
    for (uint32_t i = 0; i < skinnedMesh.vertexCount; ++i) {
        const uint32_t from = skinnedMesh.firstVertex + i, to = skinnedMesh.firstDeformed + i;
        const SkinVertex& s = g.skin[from];
        const io::SkinMatrix m =
            io::blendJoints(rowsOf(joints[s.joints.x]), rowsOf(joints[s.joints.y]),
                            rowsOf(joints[s.joints.z]), rowsOf(joints[s.joints.w]), s.weights);
        const VertexAttributes& a = g.attributes[from];
        out.positions[to] = io::skinPoint(m, g.positions[from]);
        out.attributes[to] = {io::skinNormal(m, a.normal),
                              glm::vec4(io::skinDirection(m, glm::vec3(a.tangent)), a.tangent.w), a.uv,
                              a.color};
    }
}

}  // namespace

DeformedVertices deformSkinnedMeshes(const RenderScene& scene) {
    DeformedVertices out;
    if (scene.skinnedMeshes.empty()) return out;
    const RenderSkinnedMesh& last = scene.skinnedMeshes.back();
    out.positions.resize(last.firstDeformed + last.vertexCount);
    out.attributes.resize(out.positions.size());
    for (const RenderSkinnedMesh& skinnedMesh : scene.skinnedMeshes)
        deform(scene, skinnedMesh, out);
    return out;
}

VertexPointers verticesOf(const RenderScene& scene, const DeformedVertices& deformed,
                          const RenderInstance& instance) {
    const std::ptrdiff_t first = firstVertexOf(scene, instance.primitive, instance.skinnedMesh);
    if (instance.skinnedMesh != kNoSkinnedMesh)
        return {deformed.positions.data() + first, deformed.attributes.data() + first};
    return {scene.geometry->positions.data() + first, scene.geometry->attributes.data() + first};
}

}  // namespace ag
