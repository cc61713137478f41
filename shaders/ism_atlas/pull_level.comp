#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// A coarser level of each map (Marroquim et al. 2007; Ritschel et al. 2008): of four texels the lower median of those
// that were met, by distance.
#include "ism_atlas/ism_atlas_io.h"
#include "ism_atlas/lower_median.glsl"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push { IsmLevelPush p; } push;
layout(set = 0, binding = 0, scalar) buffer Pyramid { vec4 items[]; } pyramid;

void main() {
    uint map = gl_WorkGroupID.y, size = push.p.coarseSize, inTile = gl_GlobalInvocationID.x;
    if (inTile >= size * size) return;
    uint x = inTile % size, y = inTile / size, texel = map * size * size + inTile;
    uint fine = push.p.fineOffset + (map * 2 * size + 2 * y) * 2 * size + 2 * x;
    vec4 a = pyramid.items[fine], b = pyramid.items[fine + 1];
    vec4 c = pyramid.items[fine + 2 * size], d = pyramid.items[fine + 2 * size + 1];
    pyramid.items[push.p.coarseOffset + texel] = lowerMedian(a, b, c, d);
}
