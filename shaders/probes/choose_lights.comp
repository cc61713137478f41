#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// How likely a probe's rays go to each area light: by what the light has for it, or by what some of the light's texels have
// where that is more. A light that turns away may hold texels that do not. One group of lanes a probe.
#include "common/lanes.glsl"
#include "common/texels.glsl"
#include "probes/probes_io.h"
#include "rsm/rsm_io.h"

layout(push_constant, scalar) uniform Push { ProbeRaysPush p; } push;
layout(set = 0, binding = 0) VEC4_TEXELS(texels);
layout(set = 0, binding = 1) UINT_TEXELS(memberRanges);
layout(set = 0, binding = 2) UINT_TEXELS(members);
layout(set = 0, binding = 3, scalar) uniform Maps { RsmMap items[kMaxRsmMaps]; } maps;
layout(set = 0, binding = 4, scalar) readonly buffer TileMaps { uint items[]; } tileMaps;
layout(set = 0, binding = 5) uniform sampler2D rsmNormals;
layout(set = 0, binding = 6) uniform sampler2D rsmAlbedos;
layout(set = 0, binding = 7, scalar) readonly buffer Probes { Probe items[]; } probes;
layout(set = 0, binding = 8, scalar) readonly buffer OfLights { float items[]; } ofLights;
layout(set = 0, binding = 9, scalar) buffer UpTo { float items[]; } upTo;  // sums, of each probe
layout(constant_id = 0) const bool kTexelLobes = false;

#include "probes/probe_texels.glsl"

const uint kDraws = 4;      // texels of each light that are looked at
const float kEvenly = 0.1;  // share of the rays that go to any light

// W/m² if it is seen, mean of the channels.
float expectedOf(Probe p, uint index, uint light) {
    uint count = memberCountOf(light), random = hashUint(index * 1021u + light + hashUint(push.p.step) * 31u);
    if (count == 0) return 0.0;
    MemberDraw d = MemberDraw(0, 0.0, 0.0);
    AG_DRAW_MEMBER(d, firstMember(light), count, kDraws, random, wantAt(p, texel_, s))
    return max(ofLights.items[index * push.p.valCount + light], d.sum * float(count) / float(kDraws));
}

void main() {
    uint index = gl_WorkGroupID.x, valCount = push.p.valCount, first = index * valCount, lit = 0;
    Probe p = probes.items[index];
    if (!isProbe(p)) return;
    float total = 0.0;
    for (uint base = 0; base < valCount; base += kLanes) {
        uint light = base + laneIndex();
        bool some = memberCountOf(light) > 0;
        float expected = some ? expectedOf(p, index, light) : 0.0;
        total += laneAdd(expected);
        lit += laneVote(some).count;
        if (light < valCount) upTo.items[first + light] = expected;
    }
    float before = 0.0, evenly = kEvenly * max(total, 1e-20) / float(max(lit, 1));
    for (uint base = 0; base < valCount; base += kLanes) {
        uint light = base + laneIndex();
        bool some = memberCountOf(light) > 0;
        float weight = some ? upTo.items[first + light] + evenly : 0.0;
        float end = before + laneInclusiveAdd(weight);
        before += laneAdd(weight);
        if (light < valCount) upTo.items[first + light] = end;
    }
}
