#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// A skinned mesh's own vertices: those of its mesh, moved by its joints.
#include "common/texels.glsl"
#include "skinning/skin.glsl"

layout(local_size_x = 64) in;  // kSkinGroup
layout(push_constant, scalar) uniform Push { uint firstGroup; } push;

layout(set = 0, binding = 0, scalar) readonly buffer Groups { uint items[]; } groups;  // the skinned mesh of each
layout(set = 0, binding = 1, scalar) readonly buffer SkinnedMeshes { SkinRow items[]; } skinnedMeshes;
layout(set = 0, binding = 2) VEC4_TEXELS(joints);
layout(set = 0, binding = 3, scalar) readonly buffer Skin { SkinnedVertex items[]; } skin;
layout(set = 0, binding = 4, scalar) readonly buffer Positions { vec3 items[]; } positions;
layout(set = 0, binding = 5, scalar) readonly buffer Attributes { VertexRow items[]; } attributes;
layout(set = 0, binding = 6, scalar) writeonly buffer DeformedPositions { vec3 items[]; } deformedPositions;
layout(set = 0, binding = 7, scalar) writeonly buffer DeformedAttributes { VertexRow items[]; } deformedAttributes;

void main() {
    uint group = push.firstGroup + gl_WorkGroupID.x;
    SkinRow skinnedMesh = skinnedMeshes.items[groups.items[group]];
    uint to = group * kSkinGroup + gl_LocalInvocationID.x, i = to - skinnedMesh.firstDeformed;
    if (i >= skinnedMesh.vertexCount) return;
    uint from = skinnedMesh.firstVertex + i;
    SkinnedVertex vertex = skin.items[from];
    SkinMatrix m = AG_SKIN(joints, skinnedMesh.firstJoint, vertex);
    VertexRow row = attributes.items[from];
    row.normal = skinNormal(m, row.normal);
    row.tangent.xyz = skinDirection(m, row.tangent.xyz);
    deformedPositions.items[to] = skinPoint(m, positions.items[from]);
    deformedAttributes.items[to] = row;
}
