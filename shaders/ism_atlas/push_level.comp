#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Fills the empty texels of a level from the coarser one; texels that were met stay.
#include "ism_atlas/ism_atlas_io.h"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push { IsmLevelPush p; } push;
layout(set = 0, binding = 0, scalar) buffer Pyramid { vec4 items[]; } pyramid;

void main() {
    uint map = gl_WorkGroupID.y, size = push.p.coarseSize * 2, inTile = gl_GlobalInvocationID.x;
    if (inTile >= size * size) return;
    uint x = inTile % size, y = inTile / size, texel = map * size * size + inTile;
    uint at = push.p.fineOffset + texel;
    uint coarse = push.p.coarseOffset + (map * push.p.coarseSize + y / 2) * push.p.coarseSize + x / 2;
    if (pyramid.items[at].w <= 0.0) pyramid.items[at] = pyramid.items[coarse];
}
