#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_control_flow_attributes : require
// Closes the holes of listed regions. What lies behind shows through where disks do not meet: a texel beyond a plane that
// its neighbours on two opposite sides share is a hole in that plane. What is empty then is filled by pull-push (Marroquim
// et al. 2007; Ritschel et al. 2008): from the finest coarser level that was met there, whose texels are the lower medians
// of four. Each lane has two by two texels. Traced planes, whose distance is below 0, have no holes and close none.
#include "common/texels.glsl"
#include "ism_atlas/ism_map.glsl"
#include "ism_atlas/lower_median.glsl"
#include "ism_atlas/regions.glsl"

layout(local_size_x = 8, local_size_y = 8) in;  // a region
layout(push_constant, scalar) uniform Push { IsmSplatPush p; } push;

layout(set = 0, binding = 0) VEC4_TEXELS(resolved);
layout(set = 0, binding = 1, scalar) readonly buffer Listed { uint items[]; } listed;
layout(set = 0, binding = 2, scalar) writeonly buffer Planes { vec4 items[]; } planes;

layout(constant_id = 0) const bool kTraced = false;  // static surfaces are

const float kMostApart = 0.05;  // of two texels' planes for one, relative

// What the map holds at a texel: its own or, where that is beyond the plane of a and b, that one.
void closeBetween(vec4 a, vec4 b, vec3 direction, inout vec4 texel) {
    vec3 apart = a.xyz - b.xyz;
    bool onePlane = a.w > 0.0 && b.w > 0.0 && dot(apart, apart) <= kMostApart * kMostApart * dot(a.xyz, a.xyz);
    float along = dot(a.xyz, direction);
    bool beyond = along > 0.0 && (texel.w == 0.0 || ismBeyond(along * abs(texel.w), int(push.p.tileSize)));
    if (onePlane && beyond) texel = vec4(a.xyz, 1.0 / along);
}

vec4 resolvedAt(uint map, ivec2 at) { return fetchTexel(resolved, int(regionTexel(map, uvec2(at), push.p.tileSize))); }

vec4 closed(uint map, ivec2 at, int size) {
    const ivec2 kSides[4] = ivec2[](ivec2(1, 0), ivec2(0, 1), ivec2(1, 1), ivec2(1, -1));
    vec3 direction = ismDirection((vec2(at) + 0.5) / float(size));
    vec4 texel = resolvedAt(map, at);
    [[unroll]] for (int i = 0; i < 4; ++i)
        [[unroll]] for (int far = 1; far <= kIsmWidestHole; ++far) {
            ivec2 side = kSides[i] * far, low = min(at - side, at + side), high = max(at - side, at + side);
            bool within = all(greaterThanEqual(low, ivec2(0))) && all(lessThan(high, ivec2(size)));
            side = within ? side : ivec2(0);  // a texel closes no hole in itself
            closeBetween(resolvedAt(map, at - side), resolvedAt(map, at + side), direction, texel);
        }
    return texel;
}

const uint kLevels = 4;        // the coarsest texel is as large as a region
const uint kCoarsestSide = 4;  // texels along a map at least

// Levels of the region one after the other, each a row of squares of half the side; the first has 8 by 8 texels.
shared vec4 level[85];
uint levelStart(uint i) { return (256u - (256u >> 2 * i)) / 3u; }
uint levelTexel(uint i, uvec2 at) { return levelStart(i) + at.y * (8u >> i) + at.x; }

void pull(uint i) {
    uvec2 at = gl_LocalInvocationID.xy;
    if (all(lessThan(at, uvec2(8u >> i))))
        level[levelTexel(i, at)] = lowerMedian(level[levelTexel(i - 1, 2 * at)], level[levelTexel(i - 1, 2 * at + uvec2(1, 0))],
                                               level[levelTexel(i - 1, 2 * at + uvec2(0, 1))], level[levelTexel(i - 1, 2 * at + 1)]);
}

// What a lane's empty texels are filled with; all lanes ask.
vec4 pulledPlane(uvec2 at, vec4 quad[4]) {
    level[levelTexel(0, at)] = lowerMedian(quad[0], quad[1], quad[2], quad[3]);
    for (uint i = 1; i < kLevels; ++i) {
        barrier();
        pull(i);
    }
    barrier();
    vec4 behind = vec4(0.0);
    for (uint i = 0; i < kLevels; ++i) {
        vec4 coarse = level[levelTexel(i, at >> i)];
        bool coarser = push.p.tileSize >> (i + 1) >= kCoarsestSide;
        if (behind.w <= 0.0 && coarser) behind = coarse;
    }
    return behind;
}

void main() {
    IsmRegion region = regionOf(listed.items[gl_WorkGroupID.x]);
    int size = int(push.p.tileSize);
    uvec2 at = gl_LocalInvocationID.xy;
    ivec2 corner = ivec2(region.first + 2 * at);
    vec4 quad[4];
    [[unroll]] for (int i = 0; i < 4; ++i) quad[i] = closed(region.map, corner + ivec2(i & 1, i >> 1), size);
    vec4 behind = kTraced ? vec4(0.0) : pulledPlane(at, quad);
    [[unroll]] for (int i = 0; i < 4; ++i) {
        ivec2 place = corner + ivec2(i & 1, i >> 1);
        vec4 own = vec4(quad[i].xyz, abs(quad[i].w));
        planes.items[(int(region.map) * size + place.y) * size + place.x] = own.w > 0.0 ? own : behind;
    }
}
