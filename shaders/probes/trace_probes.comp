#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Light at a probe by rays to texels, each drawn of one area light's by what it would send (resampling, Talbot et al. 2005);
// and by rays all round to whatever is near, from where a further ray asks for the light of a texel and one for the sky's:
// points of later bounces stand badly for surfaces so near. A workgroup a probe. Area lights are a control variate as long as
// anything changes.
#include "common/random.glsl"
#include "common/texels.glsl"
#include "later_bounces/later_bounces_io.h"
#include "probes/probes_io.h"
#include "rsm/rsm_io.h"
#include "sky/sky_io.h"

const uint kThreads = 32;
layout(local_size_x = kThreads) in;
layout(push_constant, scalar) uniform Push { ProbeRaysPush p; } push;
layout(set = 0, binding = 0) VEC4_TEXELS(texels);
layout(set = 0, binding = 1) UINT_TEXELS(memberRanges);
layout(set = 0, binding = 2) UINT_TEXELS(members);
layout(set = 0, binding = 3, scalar) uniform Maps { RsmMap items[kMaxRsmMaps]; } maps;
layout(set = 0, binding = 4, scalar) readonly buffer TileMaps { uint items[]; } tileMaps;
layout(set = 0, binding = 5) uniform sampler2D rsmNormals;
layout(set = 0, binding = 6) uniform sampler2D rsmAlbedos;
layout(set = 0, binding = 7) UVEC4_TEXELS(treeNodes);
layout(set = 0, binding = 8, scalar) readonly buffer TreeTriangles { vec4 items[]; } treeTriangles;
layout(set = 0, binding = 9) UVEC4_TEXELS(treePlaces);
layout(set = 0, binding = 10) UVEC4_TEXELS(moverNodes);
layout(set = 0, binding = 11, scalar) readonly buffer Probes { Probe items[]; } probes;
layout(set = 0, binding = 12, scalar) readonly buffer Rows { ProbeRow items[]; } rows;  // by area lights
layout(set = 0, binding = 13) FLOAT_TEXELS(upTo);
layout(set = 0, binding = 14, scalar) readonly buffer MeansBefore { ProbeMeans items[]; } meansBefore;
layout(set = 0, binding = 15, scalar) writeonly buffer Means { ProbeMeans items[]; } means;
layout(set = 0, binding = 16, scalar) writeonly buffer Corrected { ProbeRow items[]; } corrected;
layout(set = 0, binding = 17) VEC4_TEXELS(skyTexels);
layout(set = 0, binding = 18, scalar) uniform SkyUpTo { vec4 items[kSkyCells / 4]; } skyUpTo;
layout(set = 0, binding = 19) VEC4_TEXELS(vals);
layout(constant_id = 0) const bool kTexelLobes = false;
layout(constant_id = 1) const bool kSky = false;

#define AG_BVH_MOVERS
#include "bvh/trace.glsl"
#include "cluster_members/aim.glsl"
#include "probes/probe_texels.glsl"
#define AG_SKY_UP_TO(cell) skyUpTo.items[(cell) / 4][(cell) % 4]
#include "texel_rays/incident.glsl"

const uint kDraws = 16;          // texels of a light that one is resampled from
const uint kLightDraws = 32;     // lights that one is resampled from, for what is near
const float kMovingFrames = 32;  // that means stand for
const float kOtherFrames = 4;    // the same once the light is another
const float kAlike = 0.25;       // share by which the area lights' sum differs at most from its mean of the same light
const float kMostTimes = 4.0;    // that rays find of what area lights have
const float kTrusted = 1.0;      // frames of rays that weigh as much as area lights
const float kSettledFrames = 8;  // at rest that weigh as much as the frames before

vec3 startOf(Probe p) { return p.position + p.normal * push.p.offset; }

float totalOf(uint first) { return fetchTexel(upTo, int(first + push.p.valCount - 1)).x; }

float chanceOf(uint first, uint light) {
    float before = light > 0 ? fetchTexel(upTo, int(first + light - 1)).x : 0.0, total = totalOf(first);
    return total > 0.0 ? (fetchTexel(upTo, int(first + light)).x - before) / total : 0.0;
}

uint chooseLight(uint first, float xi) {
    uint low = 0, high = push.p.valCount - 1;
    float at = xi * totalOf(first);
    while (low < high) {
        uint middle = (low + high) / 2;
        if (at >= fetchTexel(upTo, int(first + middle)).x) low = middle + 1;
        else high = middle;
    }
    return low;
}

// One of a light's texels, for all of them.
Incident drawTexelOf(uint light, Probe p, inout uint random) {
    uint count = memberCountOf(light);
    MemberDraw d = MemberDraw(0, 0.0, 0.0);
    if (count > 0) AG_DRAW_MEMBER(d, firstMember(light), count, kDraws, random, wantAt(p, texel_, s))
    if (d.sum <= 0.0) return kNoIncident;
    RsmSurface s = AG_RSM_FETCH(texels, d.texel);
    vec3 sends = s.flux * sentTo(p.position, d.texel, s, push.p.atlasWidth);
    return Incident(endBefore(s) - startOf(p), 1.0, sends * (drawnFactorAt(p, d.texel, s) * weightOf(d, count, kDraws)));
}

// One of all texels, for all of them. `first`: of the probe's chances.
Incident drawTexel(Probe p, uint first, float xi, inout uint random) {
    uint light = chooseLight(first, xi);
    float chance = chanceOf(first, light);
    if (chance == 0.0) return kNoIncident;
    Incident drawn = drawTexelOf(light, p, random);
    drawn.sends /= chance;
    return drawn;
}

struct LightDraw {
    uint light;
    float weight;  // of what it sends, so that the mean is all lights' sum
};

// A light by about what it sends to a place near the probe, whichever way it faces.
LightDraw drawLightFor(vec3 place, inout uint random) {
    float sum = 0.0, wanted = 0.0, along = float(push.p.valCount) / float(kLightDraws);
    uint light = 0;
    for (uint i = 0; i < kLightDraws; ++i) {
        uint candidate = min(uint((float(i) + next(random)) * along), push.p.valCount - 1);
        vec4 middle = fetchTexel(vals, int(candidate) * 3);
        vec3 d = middle.xyz - place;
        float want = memberCountOf(candidate) > 0 ? meanOf(fetchTexel(vals, int(candidate) * 3 + 2).rgb) / (dot(d, d) + middle.w) : 0.0;
        sum += want;
        bool taken = want > 0.0 && (1.0 - next(random)) * sum <= want;
        light = taken ? candidate : light;
        wanted = taken ? want : wanted;
    }
    return LightDraw(light, wanted > 0.0 ? sum * along / wanted : 0.0);
}

// One of all texels, for what they send to a place near the probe.
Incident drawOnto(vec3 place, vec3 normal, inout uint random) {
    LightDraw l = drawLightFor(place, random);
    if (l.weight <= 0.0) return kNoIncident;
    Incident drawn = drawTexelOf(l.light, Probe(place, 0, normal, 0, 0), random);
    drawn.sends *= l.weight;
    return drawn;
}

#define AG_ON_KINDS 1
#define AG_ON_DRAW(kind, place, normal, random) drawOnto(place, normal, random)
#define AG_ON_SHINES push.p.emissiveReach
#define AG_ON_REFLECTS push.p.laterReach
#include "texel_rays/near_path.glsl"

// Into the hemisphere, or all round.
vec3 nearDirection(Probe p, inout uint random) {
    bool allRound = dot(p.normal, p.normal) < 0.25;
    float u = next(random), v = next(random), z = 1.0 - 2.0 * u, r = sqrt(max(1.0 - z * z, 0.0));
    return allRound ? vec3(r * cos(2.0 * kPi * v), r * sin(2.0 * kPi * v), z) : cosineDirection(p.normal, vec2(u, v));
}

// W/m², by one draw and one ray to whatever is near.
vec3 foundBy(Probe p, uint first, uint ray, uint random) {
    float xi = (float(ray) + next(random)) / float(push.p.rays);
    vec3 e = arrivingAt(startOf(p), drawTexel(p, first, xi, random), next(random));
    if (max(push.p.emissiveReach, push.p.laterReach) == 0.0) return e;
    vec3 direction = nearDirection(p, random);
    return e + nearLight(p.position, p.normal, direction, next(random), random);
}

shared vec3 sums[kThreads];

const ProbeMeans kNoMeans = ProbeMeans(vec3(0.0), 0.0, vec3(0.0), 0.0, vec3(0.0));

ProbeMeans withFrame(ProbeMeans m, vec3 byRays, vec3 byLights) {
    bool alike = abs(meanOf(byLights) - meanOf(m.byLights)) <= kAlike * meanOf(m.byLights);
    m.frames = min(m.frames + 1.0, alike ? kMovingFrames : kOtherFrames);
    m.byRays = mix(m.byRays, byRays, 1.0 / m.frames);
    m.byLights = mix(m.byLights, byLights, 1.0 / m.frames);
    m.still = push.p.still == 1 ? m.still + 1.0 : 0.0;
    m.settled = m.still > 0.0 ? mix(m.settled, byRays, 1.0 / m.still) : vec3(0.0);
    return m;
}

vec3 bouncedBy(ProbeMeans m, vec3 byLights) {
    float least = 1e-3 * meanOf(m.byLights) + 1e-20;
    vec3 times = min((m.byRays + least) / (m.byLights + least), kMostTimes);
    vec3 moving = byLights * mix(vec3(1.0), times, m.frames / (m.frames + kTrusted));
    return mix(moving, m.settled, m.still / (m.still + kSettledFrames));
}

void main() {
    uint index = gl_WorkGroupID.x, thread = gl_LocalInvocationID.x;
    Probe p = probes.items[index];
    vec3 sum = vec3(0.0);
    for (uint ray = thread; isProbe(p) && ray < push.p.rays; ray += kThreads)
        sum += foundBy(p, index * push.p.valCount, ray, hashUint(index * 4099u + ray) ^ hashUint(push.p.step * 0x9e3779b9u));
    sums[thread] = sum;
    barrier();
    if (thread > 0) return;
    for (uint i = 1; i < kThreads; ++i) sum += sums[i];
    ProbeRow row = rows.items[index];
    bool known = push.p.known == 1 && p.before > 0;
    ProbeMeans m = kNoMeans;
    if (known) m = meansBefore.items[p.before - 1];
    m = withFrame(m, sum / float(push.p.rays), row.bounced);
    means.items[index] = m;
    row.bounced = bouncedBy(m, row.bounced);
    corrected.items[index] = row;
}
