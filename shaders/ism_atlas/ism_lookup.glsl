// How much of a light a place sees, by the light's imperfect shadow map. Before: `isms`, the atlas (common/texels.glsl).
#ifndef AG_ISM_LOOKUP_GLSL
#define AG_ISM_LOOKUP_GLSL

#extension GL_EXT_control_flow_attributes : require
#include "ism_atlas/ism_map.glsl"

struct IsmTile {
    int first, size;  // texels
};

// d: from the light to the place, in the light's frame.
float ismShadow(vec4 plane, vec3 d, int size) { return ismBeyond(dot(plane.xyz, d), size) ? 1.0 : 0.0; }

// What was met in a direction, which need not be unit.
vec4 ismPlane(IsmTile tile, vec3 direction) {
    vec2 uv = ismEncode(vec3(direction.xy, max(direction.z, 0.0)));
    ivec2 at = clamp(ivec2(uv * float(tile.size)), ivec2(0), ivec2(tile.size - 1));
    return fetchTexel(isms, tile.first + at.y * tile.size + at.x);
}

// From the light's centre, the four nearest texels weighted.
float ismHardVisibility(IsmTile tile, vec3 d) {
    vec2 at = ismEncode(vec3(d.xy, max(d.z, 0.0))) * float(tile.size) - 0.5;
    vec2 low = clamp(floor(at), vec2(0.0), vec2(float(tile.size) - 2.0)), f = clamp(at - low, vec2(0.0), vec2(1.0));
    int texel = tile.first + int(low.y) * tile.size + int(low.x);
    vec4 shadow = vec4(ismShadow(fetchTexel(isms, texel), d, tile.size),
                       ismShadow(fetchTexel(isms, texel + 1), d, tile.size),
                       ismShadow(fetchTexel(isms, texel + tile.size), d, tile.size),
                       ismShadow(fetchTexel(isms, texel + tile.size + 1), d, tile.size));
    return 1.0 - mix(mix(shadow.x, shadow.y, f.x), mix(shadow.z, shadow.w, f.x), f.y);
}

// Percentage-closer soft shadows (Fernando 2005; ACRSM section 5.3.2) of a rectangle with half sides u, v in the
// light's plane. A ray from the light's point s to d passes a blocker at the share rho of the way where the centre sees it
// in the direction d + s (1 - rho) / rho.
float ismSoftVisibility(IsmTile tile, vec3 d, vec2 u, vec2 v, int taps) {
    const vec2 kSearch[5] = vec2[](vec2(0.0), vec2(0.6, 0.6), vec2(-0.6, 0.6), vec2(-0.6, -0.6), vec2(0.6, -0.6));
    // Half the light's size to the side. If the blocker is close to the light, a larger offset misses it: a wall beside the light
    // would leak.
    const float kMostSpread = 0.5;
    float blockers = 0.0, share = 0.0;
    [[unroll]] for (int i = 0; i < 5; ++i) {
        vec4 plane = ismPlane(tile, d + vec3(u * kSearch[i].x + v * kSearch[i].y, 0.0));
        float beyond = dot(plane.xyz, d), shadow = ismBeyond(beyond, tile.size) ? 1.0 : 0.0;
        blockers += shadow;
        share += shadow / max(beyond, 1.0);
    }
    if (blockers == 0.0) return 1.0;
    float rho = share / blockers, spread = min((1.0 - rho) / rho, kMostSpread);
    float shadow = 0.0;
    [[unroll]] for (int i = 0; i < taps; ++i) {
        vec2 s = fract(vec2(0.5) + float(i) * vec2(0.7548776662, 0.5698402910)) * 2.0 - 1.0;
        shadow += ismShadow(ismPlane(tile, d + vec3(u * s.x + v * s.y, 0.0) * spread), d, tile.size);
    }
    return 1.0 - shadow / float(taps);
}
#endif
