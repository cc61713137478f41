#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// The light at a probe: bounced, from the area lights the screen is lit by, through their shadow maps; and direct, from
// the lights that have RSMs, by these maps' depth. One group of lanes a probe; its lanes share out the lights.
#include "common/texels.glsl"
layout(constant_id = 0) const uint kShape = 4;
layout(constant_id = 1) const int kVisibilityTaps = 0;

layout(set = 0, binding = 0) VEC4_TEXELS(vals);
layout(set = 0, binding = 1) VEC4_TEXELS(shapes);
layout(set = 0, binding = 2) VEC4_TEXELS(isms);
layout(set = 0, binding = 3) uniform sampler2D depthMap;
#include "common/lanes.glsl"
#include "common/lights.h"
#include "probes/probes_io.h"
#include "rsm/rsm.glsl"
#include "scene/scene_io.h"
#include "val_shading/area_light.glsl"

layout(push_constant, scalar) uniform Push { ProbePush p; } push;
layout(set = 0, binding = 4, scalar) uniform Faces { RsmFace items[kMaxRsmFaces]; } faces;
layout(set = 0, binding = 5, scalar) uniform Maps { RsmMap items[kMaxRsmMaps]; } maps;
layout(set = 0, binding = 6, scalar) readonly buffer Probes { Probe items[]; } probes;
layout(set = 0, binding = 7, scalar) writeonly buffer Rows { ProbeRow items[]; } rows;
layout(set = 0, binding = 8, scalar) writeonly buffer OfLights { float items[]; } ofLights;

// Of a texel: 1 if its surface is no nearer to the light than x.
float litTexel(RsmFace face, RsmMap map, ivec2 at, vec3 x, float slack) {
    at = clamp(at, ivec2(0), ivec2(int(face.size) - 1));
    float depth = texelFetch(depthMap, ivec2(face.origin) + at, 0).x;
    vec2 ndc = (vec2(at) + 0.5) / float(face.size) * 2.0 - 1.0;
    vec4 h = face.worldFromClip * vec4(ndc, max(depth, 1e-7), 1.0);
    vec3 surface = h.xyz / h.w;
    float way = map.kind == kLightDirectional ? dot(x - surface, map.direction)
                                              : length(x - map.position) - length(surface - map.position);
    return depth <= 0.0 || way <= slack ? 1.0 : 0.0;
}

float litShare(RsmFace face, RsmMap map, vec2 ndc, vec3 x, float texel) {
    vec2 at = (ndc * 0.5 + 0.5) * float(face.size) - 0.5, low = floor(at), f = at - low;
    float slack = 2.0 * texel;
    vec4 lit;
    [[unroll]] for (int i = 0; i < 4; ++i) lit[i] = litTexel(face, map, ivec2(low) + ivec2(i & 1, i >> 1), x, slack);
    return mix(mix(lit.x, lit.y, f.x), mix(lit.z, lit.w, f.x), f.y);
}

vec3 directFrom(RsmFace face, RsmMap map, vec3 x, vec3 n, bool allRound) {
    vec4 h = face.clipFromWorld * vec4(x, 1.0);
    vec2 ndc = h.xy / h.w;
    if (h.w <= 0.0 || any(greaterThan(abs(ndc), vec2(1.0))) || inHole(map, (ndc * 0.5 + 0.5) * float(face.size))) return vec3(0.0);
    bool sun = map.kind == kLightDirectional;
    vec3 d = x - map.position;
    float distance_ = sun ? 1.0 : max(length(d), 1e-4);
    vec3 away = sun ? map.direction : d / distance_;
    float texel = 2.0 * map.tanHalf / float(face.size) * distance_;
    float strength = sun ? 1.0 : punctualIrradiance(away, distance_, map.direction, map.cosInner, map.cosOuter, map.range);
    strength *= allRound ? kProbeSphere : max(-dot(n, away), 0.0);
    return map.intensity * (strength * litShare(face, map, ndc, x, texel));
}

struct Bounced {
    vec3 e;          // W/m²
    float expected;  // of what a ray may find, mean of the channels: an imperfect shadow map may be wrong
};

Bounced bouncedFrom(uint index, vec3 x, vec3 n, bool allRound) {
    const float kLeastSeen = 0.25;
    AreaLight l = loadLight(index);
    LightFrame f = frameOf(l);
    vec3 toward = normalize(l.place.xyz - x + vec3(0.0, 1e-9, 0.0));
    vec3 unshadowed = l.power.rgb * (shapeTerm(x, allRound ? toward : n, 0.0, l, f) * (allRound ? kProbeSphere : 1.0));
    float seen = visibility(x, l, f, push.p.ismTileSize);
    return Bounced(unshadowed * seen, dot(unshadowed, vec3(1.0 / 3.0)) * max(seen, kLeastSeen));
}

void main() {
    uint index = gl_WorkGroupID.x;
    Probe probe = probes.items[index];
    bool allRound = dot(probe.normal, probe.normal) < 0.25;
    vec3 direct = vec3(0.0), bounced = vec3(0.0);
    for (uint i = laneIndex(); i < push.p.faceCount; i += kLanes)
        direct += directFrom(faces.items[i], maps.items[faces.items[i].map], probe.position, probe.normal, allRound);
    for (uint i = laneIndex(); i < push.p.valCount; i += kLanes) {
        Bounced of = bouncedFrom(i, probe.position, probe.normal, allRound);
        bounced += of.e;
        ofLights.items[index * push.p.valCount + i] = of.expected;
    }
    direct = laneAdd(direct);
    bounced = laneAdd(bounced);
    if (laneIndex() == 0) rows.items[index] = ProbeRow(direct, probe.idLow, bounced, probe.idHigh);
}
