#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Irradiance at the points from area lights, corrected by rays: what those found over what the lights sent, both as means over
// frames. As a ratio it holds at once when the light grows with every further bounce. Rays go to texels and to other points. Near
// surfaces, for which points stand badly, are met by a ray into the hemisphere; what reaches them is drawn again.
#include "common/random.glsl"
#include "common/texels.glsl"
#include "later_bounces/later_bounces_io.h"
#include "rsm/rsm_io.h"
#include "sky/sky_io.h"

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
layout(set = 0, binding = 15) VEC4_TEXELS(skyTexels);
layout(set = 0, binding = 16, scalar) uniform SkyUpTo { vec4 items[kSkyCells / 4]; } skyUpTo;
layout(constant_id = 0) const bool kTexelLobes = false;
layout(constant_id = 1) const bool kSky = false;
#define AG_BVH_MOVERS
#include "bvh/trace.glsl"
#include "bvh/met.glsl"
#include "cluster_members/aim.glsl"
#define AG_SKY_UP_TO(cell) skyUpTo.items[(cell) / 4][(cell) % 4]
#include "texel_rays/incident.glsl"

const uint kDraws = 16;        // texels that one is resampled from
const float kTrust = 2.0;      // frames: rays of fewer say little
const float kMostTimes = 4.0;  // so far area lights may be below rays; what is beyond is added

const uint kFirst = 0, kLater = 1;  // members: texels of first bounces and of emissive surfaces; points
uvec3 firstOf;

// One member of a kind, drawn. Members nearer than `nearReach` fade out: a ray into the hemisphere finds those surfaces.
Incident drawMember(uint kind, vec3 x, vec3 n, float nearReach, inout uint random) {
    if (firstOf[kind] == firstOf[kind + 1]) return kNoIncident;
    Aim aim = aimAtMember(x, n, firstOf[kind], firstOf[kind + 1], kDraws, nearReach, random);
    return Incident(aim.place - (x + n * push.p.offset), 1.0, aim.sends);
}

#define AG_ON_KINDS 2
#define AG_ON_DRAW(kind, place, normal, random) drawMember(kind, place, normal, (kind) == kLater ? push.p.nearReach : 0.0, random)
#define AG_ON_SHINES 0.0
#define AG_ON_REFLECTS push.p.nearReach
#include "texel_rays/near_path.glsl"

// By a ray to one of a kind.
vec3 fromMembers(vec3 x, vec3 n, uint kind, float nearReach, inout uint random) {
    Incident light = drawMember(kind, x, n, nearReach, random);
    return arrivingAt(x + n * push.p.offset, light, unitOf(hashUint(random)));
}

// What near surfaces send on of what reaches them.
vec3 fromNear(vec3 x, vec3 n, inout uint random) {
    if (firstOf[kLater] == firstOf[kLater + 1]) return vec3(0.0);
    float opaqueFrom = next(random);
    return nearLight(x, n, cosineDirection(n, vec2(next(random), next(random))), opaqueFrom, random);
}

vec3 irradianceByRays(vec3 x, vec3 n, uint seed) {
    vec3 e = vec3(0.0);
    uint random = hashUint(seed);
    for (uint r = 0; r < push.p.rays; ++r)
        e += fromMembers(x, n, kFirst, 0.0, random) + fromMembers(x, n, kLater, push.p.nearReach, random) + fromNear(x, n, random);
    return e / float(push.p.rays);
}

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.p.count) return;
    firstOf = kindsOfMembers(push.p.firstLater, push.p.valCount);
    RsmSurface at = AG_RSM_FETCH(points, i);
    bool due = (i / gl_WorkGroupSize.x + push.p.step) % push.p.turns == 0;
    vec3 byLights = irradiance.items[i].rgb, byRays = vec3(0.0);
    if (due) byRays = irradianceByRays(at.position, at.normal, i + push.p.step * push.p.count);
    PointMeans m = PointMeans(vec3(0.0), vec3(0.0), 0.0);
    if (push.p.valid == 1) m = before.items[i];
    if (due) {
        m.frames = min(m.frames, push.p.mostLength - 1.0) + 1.0;
        m.byRays = mix(m.byRays, byRays, 1.0 / m.frames);
        m.byLights = mix(m.byLights, byLights, 1.0 / m.frames);
    }
    means.items[i] = m;
    if (m.frames == 0.0) return;
    vec3 trusted = m.byLights * (kTrust / m.frames);
    vec3 found = m.byRays + trusted, sent = m.byLights + trusted;
    irradiance.items[i].rgb = byLights * min(found / max(sent, vec3(1e-20)), vec3(kMostTimes)) + max(found - kMostTimes * sent, vec3(0.0));
}
