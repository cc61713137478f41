#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_control_flow_attributes : require
// What lies behind shows through where disks do not meet: a texel beyond a plane that its neighbours on two opposite
// sides share is a hole in that plane. Each lane closes two by two texels and makes the one of the coarser level.
#include "ism_atlas/ism_atlas_io.h"
#include "ism_atlas/ism_map.glsl"
#include "ism_atlas/lower_median.glsl"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push { IsmLevelPush p; } push;

layout(set = 0, binding = 0) uniform samplerBuffer resolved;
layout(set = 0, binding = 1, scalar) writeonly buffer Pyramid { vec4 items[]; } pyramid;

const int kWidest = 2;          // texels to either side
const float kMostApart = 0.05;  // of two texels' planes for one, relative

// What the map holds at a texel: its own or, where that is beyond the plane of a and b, that one.
void closeBetween(vec4 a, vec4 b, vec3 direction, inout vec4 texel) {
    vec3 apart = a.xyz - b.xyz;
    bool onePlane = a.w > 0.0 && b.w > 0.0 && dot(apart, apart) <= kMostApart * kMostApart * dot(a.xyz, a.xyz);
    float along = dot(a.xyz, direction);
    bool beyond = along > 0.0 && (texel.w <= 0.0 || ismBeyond(along * texel.w, int(push.p.coarseSize) * 2));
    if (onePlane && beyond) texel = vec4(a.xyz, 1.0 / along);
}

vec4 closed(int first, ivec2 at, int size) {
    const ivec2 kSides[4] = ivec2[](ivec2(1, 0), ivec2(0, 1), ivec2(1, 1), ivec2(1, -1));
    vec3 direction = ismDirection((vec2(at) + 0.5) / float(size));
    int own = first + at.y * size + at.x;
    vec4 texel = texelFetch(resolved, own);
    [[unroll]] for (int i = 0; i < 4; ++i)
        [[unroll]] for (int far = 1; far <= kWidest; ++far) {
            ivec2 side = kSides[i] * far, low = min(at - side, at + side), high = max(at - side, at + side);
            bool within = all(greaterThanEqual(low, ivec2(0))) && all(lessThan(high, ivec2(size)));
            int offset = within ? side.y * size + side.x : 0;  // a texel closes no hole in itself
            closeBetween(texelFetch(resolved, own - offset), texelFetch(resolved, own + offset), direction, texel);
        }
    return texel;
}

void main() {
    uint map = gl_WorkGroupID.y, coarseSize = push.p.coarseSize, inTile = gl_GlobalInvocationID.x;
    if (inTile >= coarseSize * coarseSize) return;
    int size = int(coarseSize) * 2, first = int(push.p.fineOffset + map * 4 * coarseSize * coarseSize);
    ivec2 at = ivec2(inTile % coarseSize, inTile / coarseSize) * 2;
    vec4 quad[4];
    [[unroll]] for (int i = 0; i < 4; ++i) {
        ivec2 place = at + ivec2(i & 1, i >> 1);
        quad[i] = closed(first, place, size);
        pyramid.items[first + place.y * size + place.x] = quad[i];
    }
    pyramid.items[push.p.coarseOffset + map * coarseSize * coarseSize + inTile] =
        lowerMedian(quad[0], quad[1], quad[2], quad[3]);
}
