#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_KHR_shader_subgroup_ballot : require
#extension GL_KHR_shader_subgroup_shuffle : require
// Each map's own points (Ritschel et al. 2008) as disks in the surfaces' planes: a texel is met where the disk is, at
// the distance of its plane there, and keeps the nearest by an atomic minimum of its key.
#include "common/texels.glsl"
#include "ism_atlas/ism_atlas_io.h"
#include "ism_atlas/ism_light.glsl"
#include "ism_atlas/ism_map.glsl"
#include "ism_atlas/regions.glsl"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push { IsmSplatPush p; } push;

layout(set = 0, binding = 0) VEC4_TEXELS(points);
layout(set = 0, binding = 1) VEC4_TEXELS(vals);
layout(set = 0, binding = 3) UINT_TEXELS(chosen);
layout(set = 0, binding = 4, scalar) readonly buffer States { IsmMapState items[]; } states;
layout(set = 0, binding = 2, scalar) buffer Keys { uint items[]; } keys;
layout(set = 0, binding = 5) UINT_TEXELS(listed);  // maps, in any order

layout(set = 0, binding = 6, scalar) buffer Finishes { IsmFinish items[]; } finishes;

layout(constant_id = 4) const bool kListed = false;  // else every map
layout(constant_id = 5) const bool kMarks = false;   // the regions that are touched

const float kLeastSine = 0.01;  // lower above the light's plane is its own surface
const int kSmallTexels = 25;    // splatted by one lane, larger ones by the whole subgroup
const int kMostReach = 16;

uint keyOf(float distance_, uint entry) {
    const uint kLeastExponent = 111u << 11;
    uint bits = floatBitsToUint(distance_ * push.p.inverseExtent) >> 12;
    return clamp(bits, kLeastExponent, kLeastExponent + 32766u) - kLeastExponent << kIsmPointBits | entry;
}

struct Splat {
    vec3 place, plane;  // of the point and through it, in the light's frame
    vec4 edges[2];      // inward, distance
    uint entry;    // among the map's points
    float radius;  // m
    ivec2 low, high;  // texels whose centres the disk may hold
};

// How far the disk extends along the map's axes, texels: its radius across the coordinates' gradients, within its plane.
// A quarter texel is for what curves in between.
vec2 reachOf(Splat s, vec3 normal) {
    vec3 u, v;
    ismGradients(s.place, u, v);
    vec2 within = vec2(dot(u, u), dot(v, v)) - vec2(dot(u, normal), dot(v, normal)) * vec2(dot(u, normal), dot(v, normal));
    float size = float(push.p.tileSize), nearness = s.radius / length(s.place);
    return s.radius * size * (1.0 + nearness) * sqrt(max(within, vec2(0.0))) + 0.25;
}

Splat splatOf(uint map, uint entry, IsmLight light) {
    uint packed = fetchTexel(chosen, int(map * push.p.entryCount + entry - push.p.firstEntry)).x;
    uint point = min(pointOf(packed), push.p.pointCount - 1);
    Splat s;
    s.entry = entry;
    s.place = toLight(light, fetchTexel(points, int(point) * 4).xyz - light.place);
    vec4 normalAndRadius = fetchTexel(points, int(point) * 4 + 1);
    vec3 normal = toLight(light, normalAndRadius.xyz);
    s.radius = normalAndRadius.w * growthOf(packed);
    s.plane = planeThrough(s.place, normal);
    for (int k = 0; k < 2; ++k) {
        vec4 edge = fetchTexel(points, int(point) * 4 + 2 + k);
        s.edges[k] = vec4(toLight(light, edge.xyz), edge.w);
    }
    float distance_ = length(s.place);
    bool seen = light.lit && s.place.z > kLeastSine * distance_ && s.plane != vec3(0.0) && s.edges[0].w >= 0.0;
    int size = int(push.p.tileSize);
    vec2 at = ismEncode(vec3(s.place.xy, max(s.place.z, 0.0))) * float(size);
    vec2 reach = min(reachOf(s, normal), vec2(kMostReach));
    s.low = max(ivec2(ceil(at - reach - 0.5)), ivec2(0));
    s.high = min(ivec2(floor(at + reach - 0.5)), ivec2(size - 1));
    if (!seen) s.high = s.low - 1;
    return s;
}

void touch(Splat s, uint map, ivec2 texel) {
    vec3 w = ismDirection((vec2(texel) + 0.5) / float(push.p.tileSize));
    vec3 hit = w / max(dot(s.plane, w), 1e-12);
    vec3 off = hit - s.place;
    bool inside = dot(off, off) <= s.radius * s.radius &&
                  dot(off, s.edges[0].xyz) >= -s.edges[0].w && dot(off, s.edges[1].xyz) >= -s.edges[1].w;
    if (!inside) return;
    atomicMin(keys.items[regionTexel(map, uvec2(texel), push.p.tileSize)], keyOf(length(hit), s.entry));
}

void splatAlone(Splat s, uint map) {
    for (int y = s.low.y; y <= s.high.y; ++y)
        for (int x = s.low.x; x <= s.high.x; ++x) touch(s, map, ivec2(x, y));
}

void splatTogether(Splat s, uint map) {
    ivec2 extent = s.high - s.low + 1;
    const int lanes = int(min(gl_SubgroupSize, gl_WorkGroupSize.x));  // of large subgroups not all are there
    for (int i = int(gl_SubgroupInvocationID); i < extent.x * extent.y; i += lanes)
        touch(s, map, s.low + ivec2(i % extent.x, i / extent.x));
}

// Also those where a hole may be closed by what was met.
void markRegions(Splat s, uint map) {
    int side = int(push.p.tileSize / kIsmRegionSide);
    ivec2 first = max(s.low - kIsmWidestHole, ivec2(0)) / int(kIsmRegionSide);
    ivec2 last = min((s.high + kIsmWidestHole) / int(kIsmRegionSide), ivec2(side - 1));
    for (int y = first.y; y <= last.y; ++y)
        for (int x = first.x; x <= last.x; ++x) {
            int region = y * side + x;
            atomicOr(finishes.items[map].touched[region / 32], 1u << (region & 31));
        }
}

Splat splatOfLane(Splat mine, uint lane) {
    Splat s;
    s.place = subgroupShuffle(mine.place, lane);
    s.plane = subgroupShuffle(mine.plane, lane);
    for (int k = 0; k < 2; ++k) s.edges[k] = subgroupShuffle(mine.edges[k], lane);
    s.entry = subgroupShuffle(mine.entry, lane);
    s.radius = subgroupShuffle(mine.radius, lane);
    s.low = subgroupShuffle(mine.low, lane);
    s.high = subgroupShuffle(mine.high, lane);
    return s;
}

void main() {
    uint map = kListed ? fetchTexel(listed, int(gl_WorkGroupID.y)).x : gl_WorkGroupID.y;
    uint entry = push.p.firstEntry + min(gl_GlobalInvocationID.x, push.p.entryCount - 1);
    Splat mine = splatOf(map, entry, AG_ISM_LIGHT(vals, map));
    if (gl_GlobalInvocationID.x >= states.items[map].pointCount) mine.high = mine.low - 1;
    ivec2 extent = mine.high - mine.low + 1;
    bool small = any(lessThan(extent, ivec2(1))) || extent.x * extent.y <= kSmallTexels;
    if (small) splatAlone(mine, map);
    if (kMarks && all(greaterThanEqual(extent, ivec2(1)))) markRegions(mine, map);
    uvec4 large = subgroupBallot(!small);
    while (large != uvec4(0)) {
        uint lane = subgroupBallotFindLSB(large);
        large[lane / 32] &= large[lane / 32] - 1;
        splatTogether(splatOfLane(mine, lane), map);
    }
}
