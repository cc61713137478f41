// Skinned meshes as the GPU sees them. Scalar layout.
#ifndef AG_SKINNING_IO_H
#define AG_SKINNING_IO_H

#include "common/portable.h"

#ifdef __cplusplus
namespace ag::io {
#endif

const uint kSkinGroup = 64;  // vertices a group deforms, all of one skinned mesh

struct SkinRow {
    uint firstVertex;  // of the mesh as it was modelled
    uint vertexCount;
    uint firstDeformed;  // of the skinned mesh's own, a multiple of kSkinGroup
    uint firstJoint;
};

struct SkinnedVertex {  // who moves it
    uvec2 joints;       // of the skinned mesh's, two in 16 bits each
    vec4 weights;
};

struct VertexRow {  // all but the position
    vec3 normal;
    vec4 tangent;
    vec2 uv;
    uint color;
};

#ifdef __cplusplus
}  // namespace ag::io
#endif
#endif
