#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Irradiance at the points from area lights, corrected by rays to texels of those lights: what rays found over what the lights
// sent, both as means over frames. As a ratio it holds at once when the light grows with every further bounce.
#include "common/texels.glsl"
#include "later_bounces/later_bounces_io.h"
#include "rsm/rsm_io.h"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push { TracePush p; } push;

layout(set = 0, binding = 0) VEC4_TEXELS(points);  // RsmTexel
layout(set = 0, binding = 1) VEC4_TEXELS(texels);
layout(set = 0, binding = 2) UINT_TEXELS(memberRanges);
layout(set = 0, binding = 3) UINT_TEXELS(members);
layout(set = 0, binding = 4) UVEC4_TEXELS(treeNodes);
layout(set = 0, binding = 5) UVEC4_TEXELS(moverNodes);
layout(set = 0, binding = 6) UVEC4_TEXELS(treePlaces);
layout(set = 0, binding = 7, scalar) readonly buffer Triangles { vec4 items[]; } treeTriangles;
layout(set = 0, binding = 8, scalar) buffer Irradiance { vec4 items[]; } irradiance;  // W/m²
layout(set = 0, binding = 9, scalar) readonly buffer Before { PointMeans items[]; } before;
layout(set = 0, binding = 10, scalar) writeonly buffer Means { PointMeans items[]; } means;
layout(set = 0, binding = 11, scalar) uniform Maps { RsmMap items[kMaxRsmMaps]; } maps;
layout(set = 0, binding = 12, scalar) readonly buffer TileMaps { uint items[]; } tileMaps;
layout(set = 0, binding = 13) uniform sampler2D rsmNormals;
layout(set = 0, binding = 14) uniform sampler2D rsmAlbedos;
layout(constant_id = 0) const bool kTexelLobes = false;
#define AG_BVH_MOVERS
#include "bvh/trace.glsl"
#include "cluster_members/aim.glsl"

const uint kDraws = 16;        // texels that one is resampled from
const float kTrust = 2.0;      // frames: rays of fewer say little
const float kMostTimes = 4.0;  // so far area lights may be below rays; what is beyond is added

// By rays to the first bounce's texels and those of emissive surfaces, and to points.
vec3 irradianceByRays(vec3 x, vec3 n, uint seed) {
    uvec3 firstOf = kindsOfMembers(push.p.firstLater, push.p.valCount);
    vec3 start = x + n * push.p.offset, e = vec3(0.0);
    uint random = hashUint(seed);
    for (uint r = 0; r < 2 * push.p.rays; ++r) {
        uint kind = r & 1;
        if (firstOf[kind] == firstOf[kind + 1]) continue;
        Aim aim = aimAtMember(x, n, firstOf[kind], firstOf[kind + 1], kDraws, random);
        if (aim.sends.x + aim.sends.y + aim.sends.z <= 0.0) continue;
        random = hashUint(random);
        BvhRay ray = BvhRay(start, aim.place - start, 1.0, unitOf(random), true, 0, 0);
        if (!traceOccluders(ray)) e += aim.sends;
    }
    return e / float(push.p.rays);
}

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.p.count) return;
    RsmSurface at = AG_RSM_FETCH(points, i);
    vec3 byLights = irradiance.items[i].rgb, byRays = irradianceByRays(at.position, at.normal, i + push.p.step * push.p.count);
    bool known = push.p.valid == 1;
    float frames = (known ? min(before.items[i].frames, push.p.mostLength - 1.0) : 0.0) + 1.0;
    vec3 rays = known ? mix(before.items[i].byRays, byRays, 1.0 / frames) : byRays;
    vec3 lights = known ? mix(before.items[i].byLights, byLights, 1.0 / frames) : byLights;
    means.items[i].byRays = rays;
    means.items[i].byLights = lights;
    means.items[i].frames = frames;
    vec3 trusted = lights * (kTrust / frames);
    vec3 found = rays + trusted, sent = lights + trusted;
    irradiance.items[i].rgb = byLights * min(found / max(sent, vec3(1e-20)), vec3(kMostTimes)) + max(found - kMostTimes * sent, vec3(0.0));
}
