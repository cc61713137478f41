#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// A coarser level of each map (Marroquim et al. 2007; Ritschel et al. 2008): of four texels the lower median of those
// that were met, by distance.
#include "ism_atlas/ism_atlas_io.h"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push { IsmLevelPush p; } push;
layout(set = 0, binding = 0, scalar) buffer Pyramid { vec4 items[]; } pyramid;

// Of two planes the nearer first; none goes last.
void order(inout vec4 a, inout vec4 b) {
    bool swap = b.w > 0.0 && (a.w <= 0.0 || b.w < a.w);
    vec4 first = swap ? b : a;
    b = swap ? a : b;
    a = first;
}

void main() {
    uint map = gl_WorkGroupID.y, size = push.p.coarseSize, inTile = gl_GlobalInvocationID.x;
    if (inTile >= size * size) return;
    uint x = inTile % size, y = inTile / size, texel = map * size * size + inTile;
    uint fine = push.p.fineOffset + (map * 2 * size + 2 * y) * 2 * size + 2 * x;
    vec4 a = pyramid.items[fine], b = pyramid.items[fine + 1];
    vec4 c = pyramid.items[fine + 2 * size], d = pyramid.items[fine + 2 * size + 1];
    order(a, b);
    order(c, d);
    order(a, c);
    order(b, d);
    order(b, c);
    pyramid.items[push.p.coarseOffset + texel] = c.w > 0.0 ? b : a;
}
