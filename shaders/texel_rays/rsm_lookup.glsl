// The texel of a reflective shadow map that stands for a place on a surface. Before: `faces`, `maps`, VEC4_TEXELS texels.
#ifndef AG_RSM_LOOKUP_GLSL
#define AG_RSM_LOOKUP_GLSL

#include "common/lights.h"
#include "rsm/rsm.glsl"

const uint kNoTexel = 0xffffffffu;
const float kTexelReach = 2.0;   // of a texel's side: as far as it stands for its surface
const float kTexelDepth = 0.25;  // and before or behind its plane

// The one that the map's light sees there, lit and on the same surface; else none.
uint texelAt(uint mapIndex, uint atlasWidth, vec3 place) {
    RsmMap map = maps.items[mapIndex];
    vec3 d = place - map.position;
    RsmFace face = faces.items[map.firstFace + (map.kind == kLightPoint ? cubeFace(d) : 0u)];
    vec4 clip = face.clipFromWorld * vec4(place, 1.0);
    vec2 at = (clip.xy / max(clip.w, 1e-6) * 0.5 + 0.5) * float(face.size);
    bool inside = clip.w > 0.0 && all(greaterThanEqual(at, vec2(0.0))) && all(lessThan(at, vec2(face.size)));
    uvec2 coord = face.origin + min(uvec2(max(at, vec2(0.0))), uvec2(face.size - 1));
    uint texel = rsmIndexOfCoord(coord, atlasWidth);
    RsmSurface s = AG_RSM_FETCH(texels, texel);
    vec3 apart = place - s.position;
    float plane = dot(apart, s.normal);
    bool same = dot(apart, apart) < kTexelReach * kTexelReach * s.area && plane * plane < kTexelDepth * kTexelDepth * s.area;
    return inside && same && s.weight > 0.0 ? texel : kNoTexel;
}
#endif
