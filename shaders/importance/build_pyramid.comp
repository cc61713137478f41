#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Sums 2x2 children level by level; one workgroup a face.
#include "importance/pyramid.glsl"
#include "rsm/rsm_io.h"

layout(local_size_x = 256) in;
layout(push_constant, scalar) uniform Push { ImportanceSettings settings; } push;

layout(set = 0, binding = 0, scalar) uniform Faces { RsmFace items[kMaxRsmFaces]; } faces;
layout(set = 0, binding = 1, scalar) coherent buffer Pyramid { float items[]; } pyramid;

void main() {
    uint base = gl_WorkGroupID.x * push.settings.pyramidStride;
    uint top = pyramidTopLevel(faces.items[gl_WorkGroupID.x].size);
    for (uint level = 1; level <= top; ++level) {
        uint fine = base + pyramidLevelOffset(top, level - 1);
        uint coarse = base + pyramidLevelOffset(top, level);
        uint count = 1u << (2u * (top - level));
        for (uint i = gl_LocalInvocationID.x; i < count; i += gl_WorkGroupSize.x) {
            float sum = 0.0;
            for (uint child = 0; child < 4; ++child) sum += pyramid.items[fine + 4 * i + child];
            pyramid.items[coarse + i] = sum;
        }
        memoryBarrierBuffer();
        barrier();
    }
}
