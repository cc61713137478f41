#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Light at a probe by rays to texels, each drawn of one area light's by what it would send (resampling, Talbot et al. 2005). A
// workgroup a probe. Area lights are a control variate as long as anything changes.
#include "common/texels.glsl"
#include "probes/probes_io.h"
#include "rsm/rsm_io.h"

const uint kThreads = 64;
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
layout(constant_id = 0) const bool kTexelLobes = false;

#define AG_BVH_MOVERS
#include "bvh/trace.glsl"
#include "cluster_members/aim.glsl"
#include "probes/probe_texels.glsl"

const uint kDraws = 16;          // texels of a light that one is resampled from
const float kMovingFrames = 16;  // that means stand for
const float kAlike = 0.25;       // share by which the area lights' sum differs at most from its mean of the same light
const float kMostTimes = 4.0;    // that rays find of what area lights have
const float kTrusted = 1.0;      // frames of rays that weigh as much as area lights
const float kSettledFrames = 8;  // at rest that weigh as much as the frames before

struct Chosen {
    uint light;
    float chance;  // 0: there is none
};

Chosen chooseLight(uint probe, float xi) {
    uint first = probe * push.p.valCount, low = 0, high = push.p.valCount - 1;
    float total = fetchTexel(upTo, int(first + high)).x, at = xi * total;
    while (low < high) {
        uint middle = (low + high) / 2;
        if (at >= fetchTexel(upTo, int(first + middle)).x) low = middle + 1;
        else high = middle;
    }
    float before = low > 0 ? fetchTexel(upTo, int(first + low - 1)).x : 0.0;
    return Chosen(low, total > 0.0 ? (fetchTexel(upTo, int(first + low)).x - before) / total : 0.0);
}

// W/m², of all texels by one of them.
vec3 foundBy(Probe p, uint index, uint ray, uint random) {
    random = hashUint(random);
    Chosen c = chooseLight(index, (float(ray) + unitOf(random)) / float(push.p.rays));
    uint count = memberCountOf(c.light);
    if (c.chance <= 0.0 || count == 0) return vec3(0.0);
    MemberDraw d = MemberDraw(0, 0.0, 0.0);
    AG_DRAW_MEMBER(d, firstMember(c.light), count, kDraws, random, wantAt(p, texel_, s))
    if (d.sum <= 0.0) return vec3(0.0);
    RsmSurface s = AG_RSM_FETCH(texels, d.texel);
    vec3 sends = s.flux * sentTo(p.position, d.texel, s, push.p.atlasWidth);
    vec3 start = p.position + p.normal * push.p.offset;
    BvhRay way = BvhRay(start, endBefore(s) - start, 1.0, unitOf(hashUint(random)), true, 0, 0);
    return traceOccluders(way) ? vec3(0.0) : sends * (factorAt(p, s) * weightOf(d, count, kDraws) / c.chance);
}

shared vec3 sums[kThreads];

const ProbeMeans kNoMeans = ProbeMeans(vec3(0.0), 0.0, vec3(0.0), 0.0, vec3(0.0));

ProbeMeans withFrame(ProbeMeans m, vec3 byRays, vec3 byLights) {
    bool alike = abs(meanOf(byLights) - meanOf(m.byLights)) <= kAlike * meanOf(m.byLights);
    m.frames = min(alike ? m.frames + 1.0 : 1.0, kMovingFrames);
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
    bool some = p.idLow != ~0u || p.idHigh != ~0u;
    vec3 sum = vec3(0.0);
    for (uint ray = thread; some && ray < push.p.rays; ray += kThreads)
        sum += foundBy(p, index, ray, hashUint(index * 4099u + ray) ^ hashUint(push.p.step * 0x9e3779b9u));
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
