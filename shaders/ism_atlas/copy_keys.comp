#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// The still layer's keys, for the moving one to be splatted over.
#include "ism_atlas/ism_atlas_io.h"

layout(local_size_x = 256) in;
layout(push_constant, scalar) uniform Push { IsmSplatPush p; } push;

layout(set = 0, binding = 0) uniform usamplerBuffer still;
layout(set = 0, binding = 1, scalar) writeonly buffer Keys { uint items[]; } keys;

void main() {
    uint texel = gl_WorkGroupID.y * push.p.tileSize * push.p.tileSize + gl_GlobalInvocationID.x;
    keys.items[texel] = texelFetch(still, int(texel)).x;
}
