// How much texels of reflective shadow maps send to a probe. Before: what texel_factor.glsl needs; push.p.atlasWidth.
#ifndef AG_PROBE_TEXELS_GLSL
#define AG_PROBE_TEXELS_GLSL

#include "cluster_members/texel_factor.glsl"
#include "common/near_share.glsl"
#include "probes/probes_io.h"

// Else the row fills the buffer up.
bool isProbe(Probe p) { return p.idLow != ~0u || p.idHigh != ~0u; }

// What a texel sends to the probe over its flux, if nothing stands between, 1/m².
float factorAt(Probe p, RsmSurface s) {
    bool allRound = dot(p.normal, p.normal) < 0.25;
    vec3 toward = allRound ? normalize(s.position - p.position + vec3(0.0, 1e-9, 0.0)) : p.normal;
    return factorOf(p.position, toward, s) * (allRound ? kProbeSphere : 1.0);
}

// The same of draws: of points near the probe rays to whatever is near find the surfaces.
float drawnFactorAt(Probe p, uint texel, RsmSurface s) {
    uint map = mapOfTexel(texel);
    float reach = map == push.p.emissiveMap ? push.p.emissiveReach : map == push.p.laterMap ? push.p.laterReach : 0.0;
    float ofNear = map == push.p.laterMap ? s.cosine : 1.0;  // what lights without maps make them send is not asked for there
    return factorAt(p, s) * (1.0 - ofNear * nearShare(distance(s.position, p.position), reach));
}

// The same of its light, mean of the channels, W/m².
float wantAt(Probe p, uint texel, RsmSurface s) {
    return drawnFactorAt(p, texel, s) * s.weight * meanOf(sentTo(p.position, texel, s, push.p.atlasWidth));
}

uint memberCountOf(uint light) { return light < push.p.clusterCount ? fetchTexel(memberRanges, int(light * 2 + 1)).x : 0; }
#endif
