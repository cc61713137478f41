#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Of listed regions the nearest points' planes and distances, for the lookup. Where the surface is curved, the plane is
// moved behind it, so that a fold does not shadow itself.
#include "common/texels.glsl"
#include "ism_atlas/ism_atlas_io.h"
#include "ism_atlas/ism_light.glsl"
#include "ism_atlas/regions.glsl"

layout(local_size_x = 256) in;  // a region
layout(push_constant, scalar) uniform Push { IsmSplatPush p; } push;

layout(constant_id = 0) const bool kPlanes = true;  // else distances
layout(constant_id = 2) const bool kMovable = false;  // some points may move
layout(constant_id = 1) const bool kLast = false;   // nothing is closed: maps row by row
layout(constant_id = 3) const bool kTraced = false;  // points are those of movable surfaces alone, over traced planes

layout(set = 0, binding = 0) VEC4_TEXELS(points);
layout(set = 0, binding = 1) VEC4_TEXELS(vals);
layout(set = 0, binding = 2) UINT_TEXELS(keys);
layout(set = 0, binding = 4) UINT_TEXELS(staticChosen);
layout(set = 0, binding = 6) UINT_TEXELS(movableChosen);
layout(set = 0, binding = 7) VEC4_TEXELS(tracedPlanes);
layout(set = 0, binding = 5, scalar) readonly buffer Listed { uint items[]; } listed;
layout(set = 0, binding = 3, scalar) writeonly buffer Planes { vec4 items[]; } planes;

// How far the surface may lie behind what the texel holds, within a disk or the texel, whichever is larger: a curvature of k
// gives k r² / 2; what is known by its distance alone may slope as it likes.
float depthWithin(float curvature, float radius, float distance_) {
    float r = max(radius, kIsmHalfTexel * distance_ / float(push.p.tileSize));
    return kPlanes ? min(0.5 * curvature * r * r, r) : r;
}

// The push constants are the movable layer's.
uint chosenOf(uint map, uint entry) {
    uint movableEntry = min(entry - push.p.firstEntry, push.p.entryCount - 1u), staticEntry = min(entry, push.p.firstEntry - 1u);
    return kMovable && entry >= push.p.firstEntry ? fetchTexel(movableChosen, int(map * push.p.entryCount + movableEntry)).x
                                                 : fetchTexel(staticChosen, int(map * push.p.firstEntry + staticEntry)).x;
}

void main() {
    IsmRegion region = regionOf(listed.items[gl_WorkGroupID.x]);
    uint map = region.map;
    uint texel = regionTexel(map, region.first, push.p.tileSize) + gl_LocalInvocationID.x;
    uint key = fetchTexel(keys, int(texel)).x;
    uint packed = chosenOf(map, key & ((1u << kIsmPointBits) - 1u));
    int point = int(min(pointOf(packed), push.p.pointCount - 1u)) * 4;
    IsmLight light = AG_ISM_LIGHT(vals, map);
    vec4 place = fetchTexel(points, point);
    vec3 p = toLight(light, place.xyz - light.place);
    float distance_ = length(p);
    vec4 normalAndRadius = fetchTexel(points, point + 1);
    // Farther along the way from the light: there the surface is for certain behind.
    p *= 1.0 + depthWithin(place.w, normalAndRadius.w * growthOf(packed), distance_) / max(distance_, 1e-6);
    vec3 normal = kPlanes ? toLight(light, normalAndRadius.xyz) : p / max(length(p), 1e-20);
    vec3 m = planeThrough(p, normal);
    uvec2 at = region.first + uvec2(gl_LocalInvocationID.x % kIsmRegionSide, gl_LocalInvocationID.x / kIsmRegionSide);
    uint row = (map * push.p.tileSize + at.y) * push.p.tileSize + at.x;
    vec4 behind = kTraced ? fetchTexel(tracedPlanes, int(row)) : vec4(0.0);
    bool met = key != kIsmNoPoint && (behind.w <= 0.0 || distance_ < behind.w);
    if (!kLast) behind.w = -behind.w;  // closes no hole
    planes.items[kLast ? row : texel] = met ? vec4(m, distance_) : behind;
}
