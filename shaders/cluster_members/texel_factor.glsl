// How much a texel of many sends to a place. Before: what draw_member.glsl and texel_lobe.glsl need.
#ifndef AG_TEXEL_FACTOR_GLSL
#define AG_TEXEL_FACTOR_GLSL

#include "cluster_members/draw_member.glsl"
#include "common/form_factors.h"
#include "rsm/texel_lobe.glsl"

// What a texel sends to a place over its flux, if nothing stands between, 1/m².
float factorOf(vec3 place, vec3 normal, RsmSurface s) {
    return s.weight > 0.0 ? diskVectorFactor(place, normal, s.position, s.normal, s.area * kInvPi) / s.area : 0.0;
}

float meanOf(vec3 v) { return (v.x + v.y + v.z) / 3.0; }
#endif
