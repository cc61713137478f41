// How much texels of reflective shadow maps send to a probe. Before: what texel_factor.glsl needs; push.p.atlasWidth.
#ifndef AG_PROBE_TEXELS_GLSL
#define AG_PROBE_TEXELS_GLSL

#include "cluster_members/texel_factor.glsl"
#include "probes/probes_io.h"

// What a texel sends to the probe over its flux, if nothing stands between, 1/m².
float factorAt(Probe p, RsmSurface s) {
    bool allRound = dot(p.normal, p.normal) < 0.25;
    vec3 toward = allRound ? normalize(s.position - p.position + vec3(0.0, 1e-9, 0.0)) : p.normal;
    return factorOf(p.position, toward, s) * (allRound ? kProbeSphere : 1.0);
}

// The same of its light, mean of the channels, W/m².
float wantAt(Probe p, uint texel, RsmSurface s) {
    return factorAt(p, s) * s.weight * meanOf(sentTo(p.position, texel, s, push.p.atlasWidth));
}

uint memberCountOf(uint light) { return fetchTexel(memberRanges, int(light * 2 + 1)).x; }
#endif
