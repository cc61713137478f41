#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Fills the empty texels of a level from the coarser one, two by two; texels that were met stay.
#include "ism_atlas/ism_atlas_io.h"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push { IsmLevelPush p; } push;
layout(set = 0, binding = 0, scalar) buffer Pyramid { vec4 items[]; } pyramid;

void main() {
    uint map = gl_WorkGroupID.y, size = push.p.coarseSize, inTile = gl_GlobalInvocationID.x;
    if (inTile >= size * size) return;
    vec4 coarse = pyramid.items[push.p.coarseOffset + map * size * size + inTile];
    uint fine = push.p.fineOffset + (map * 2 * size + inTile / size * 2) * 2 * size + inTile % size * 2;
    for (uint i = 0; i < 4; ++i) {
        uint at = fine + (i >> 1) * 2 * size + (i & 1);
        if (pyramid.items[at].w <= 0.0) pyramid.items[at] = coarse;
    }
}
