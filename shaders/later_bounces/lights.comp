#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Straight light on the points of lights that have no reflective shadow map: by rays, so that nothing leaks. Of many faint
// lights some are drawn, and count for the others.
#include "common/sampling.h"
#include "common/texels.glsl"
#include "later_bounces/later_bounces_io.h"
#include "rsm/rsm_io.h"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push { PointLightsPush p; } push;

layout(set = 0, binding = 0) VEC4_TEXELS(texels);  // RsmTexel
layout(set = 0, binding = 1, scalar) readonly buffer Lights { PointLight items[]; } lights;
layout(set = 0, binding = 2, scalar) writeonly buffer Irradiance { vec4 items[]; } irradiance;  // W/m²
layout(set = 0, binding = 3) UVEC4_TEXELS(treeNodes);
layout(set = 0, binding = 4) UVEC4_TEXELS(moverNodes);
layout(set = 0, binding = 5) UVEC4_TEXELS(treePlaces);
layout(set = 0, binding = 6, scalar) readonly buffer Triangles { vec4 items[]; } treeTriangles;
#define AG_BVH_MOVERS
#include "bvh/trace.glsl"
#include "later_bounces/arriving.glsl"

const float kSureShare = 1.0 / 16.0;  // of all unshadowed light, from which a light is always asked for

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.p.count) return;
    vec3 place = fetchTexel(texels, int(i) * 3).xyz, normal = fetchTexel(texels, int(i) * 3 + 1).xyz, sum = vec3(0.0);
    float all = 0.0;
    for (uint k = 0; k < push.p.lightCount; ++k) all += most(arrivingFrom(lights.items[k], place, normal).irradiance);
    vec3 origin = place + normal * push.p.offset;
    for (uint k = 0; k < push.p.lightCount; ++k) {
        Arriving a = arrivingFrom(lights.items[k], place, normal);
        float chance = min(most(a.irradiance) / max(kSureShare * all, 1e-30), 1.0);
        if (chance <= 0.0 || hashToUnit(i * 8191u + k) >= chance) continue;
        BvhRay ray = BvhRay(origin, a.toLight, a.distance, hashToUnit(i + k * 31u), true, 0, 0);
        if (!traceOccluders(ray)) sum += a.irradiance / chance;
    }
    irradiance.items[i] = vec4(sum, 1.0);
}
