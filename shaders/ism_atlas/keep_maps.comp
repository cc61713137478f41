#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Maps that are kept as they were; the others start empty.
#include "common/texels.glsl"
#include "ism_atlas/ism_atlas_io.h"

layout(local_size_x = 256) in;
layout(push_constant, scalar) uniform Push { IsmSplatPush p; } push;

layout(set = 0, binding = 0) UINT_TEXELS(previous);
layout(set = 0, binding = 1, scalar) readonly buffer States { IsmMapState items[]; } states;
layout(set = 0, binding = 2, scalar) writeonly buffer Kept { uint items[]; } kept;

void main() {
    uint texel = gl_WorkGroupID.y * push.p.tileSize * push.p.tileSize + gl_GlobalInvocationID.x;
    uint old = fetchTexel(previous, int(texel)).x;
    kept.items[texel] = states.items[gl_WorkGroupID.y].kept != 0 ? old : kIsmNoPoint;
}
