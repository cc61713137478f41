#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Each map gets its own share of the points (Ritschel et al. 2008), as disks in the surfaces' planes: a texel is met
// where the disk is, at the distance of its plane there, and keeps the nearest by an atomic minimum of its key.
#include "common/hemisphere_map.h"
#include "ism_atlas/ism_atlas_io.h"
#include "ism_atlas/ism_light.glsl"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push { IsmSplatPush p; } push;

layout(set = 0, binding = 0) uniform samplerBuffer points;
layout(set = 0, binding = 1) uniform samplerBuffer vals;
layout(set = 0, binding = 2, scalar) buffer Keys { uint items[]; } keys;

const float kLeastSine = 0.01;  // lower above the light's plane is its own surface
const int kMostTexels = 3;      // of a splat to each side; what a nearer point leaves open is filled afterwards

uint keyOf(float distance_, uint point) {
    const uint kLeastExponent = 111u << 11;
    uint bits = floatBitsToUint(distance_ * push.p.inverseExtent) >> 12;
    return clamp(bits, kLeastExponent, kLeastExponent + 32766u) - kLeastExponent << kIsmPointBits | point;
}

void main() {
    uint map = gl_WorkGroupID.y;
    if (gl_GlobalInvocationID.x >= push.p.pointsPerMap) return;
    uint point = (map * push.p.pointsPerMap + gl_GlobalInvocationID.x) % push.p.pointCount;
    IsmLight light = AG_ISM_LIGHT(vals, map);
    vec3 p = toLight(light, texelFetch(points, int(point) * 2).xyz - light.place);
    float distance2 = max(dot(p, p), 1e-12), distance_ = sqrt(distance2);
    if (!light.lit || p.z <= kLeastSine * distance_) return;
    vec3 m = planeThrough(p, toLight(light, texelFetch(points, int(point) * 2 + 1).xyz));
    if (m == vec3(0.0)) return;

    int size = int(push.p.tileSize);
    vec2 at = hemisphereEncode(p) * float(size);
    // Half the tile's side spans about a right angle.
    float reach = push.p.pointRadius / distance_ * float(size) * (2.0 * kInvPi);
    int r = clamp(int(ceil(reach)), 0, kMostTexels);
    ivec2 centre = clamp(ivec2(at), ivec2(0), ivec2(size - 1));
    ivec2 low = max(centre - r, ivec2(0)), high = min(centre + r, ivec2(size - 1));
    float radius2 = push.p.pointRadius * push.p.pointRadius;
    uint tile = map * push.p.tileSize * push.p.tileSize;
    for (int y = low.y; y <= high.y; ++y)
        for (int x = low.x; x <= high.x; ++x) {
            vec3 w = hemisphereDirection((vec2(x, y) + 0.5) / float(size));
            vec3 hit = w / max(dot(m, w), 1e-12);
            vec3 off = hit - p;
            bool isCentre = x == centre.x && y == centre.y;
            if (dot(off, off) > radius2 && !isCentre) continue;
            float d = isCentre ? distance_ : length(hit);
            atomicMin(keys.items[tile + uint(y * size + x)], keyOf(d, point));
        }
}
