// The texel of a reflective shadow map that stands for a place on a surface. Before: `faces`, `maps`, VEC4_TEXELS texels.
#ifndef AG_RSM_LOOKUP_GLSL
#define AG_RSM_LOOKUP_GLSL

#include "common/lights.h"
#include "rsm/rsm.glsl"

const uint kNoTexel = 0xffffffffu;
const float kTexelReach = 2.0;   // of a texel's side: as far as it stands for its surface
const float kTexelDepth = 0.25;  // and before or behind its plane
const float kTexelTurn = 0.5;    // cosine to its normal, at least: vertices' normals bend it

// Whether a texel stands for a place, and how near it is.
struct TexelMatch {
    bool same;
    float squared;  // of the distance, m²
};

TexelMatch matchTexel(RsmSurface s, vec3 place, vec3 normal) {
    vec3 apart = place - s.position;
    float plane = dot(apart, s.normal), squared = dot(apart, apart);
    bool near = s.weight > 0.0 && dot(s.normal, normal) > kTexelTurn && squared < kTexelReach * kTexelReach * s.area;
    return TexelMatch(near && plane * plane < kTexelDepth * kTexelDepth * s.area, squared);
}

struct MapPlace {
    RsmFace face;
    vec2 at;      // texels of the face
    bool inside;  // the map's light falls there, if anything, and no other level's map has it
};

MapPlace placeInMap(RsmMap map, vec3 place) {
    RsmFace face = faces.items[map.firstFace + (map.kind == kLightPoint ? cubeFace(place - map.position) : 0u)];
    vec4 clip = face.clipFromWorld * vec4(place, 1.0);
    vec2 at = (clip.xy / max(clip.w, 1e-6) * 0.5 + 0.5) * float(face.size);
    bool inside = clip.w > 0.0 && all(greaterThanEqual(at, vec2(0.0))) && all(lessThan(at, vec2(face.size)));
    return MapPlace(face, at, inside && !inHole(map, at));
}

// The one that the map's light sees there, lit and on the same surface; else none. In a crease or beside a shadow's edge it may
// stand for another surface: then one of those about it that does not. `normal`: of the surface, unit.
uint texelAt(MapPlace p, uint atlasWidth, vec3 place, vec3 normal) {
    if (!p.inside) return kNoTexel;
    RsmFace face = p.face;
    vec2 at = p.at;
    uint texel = rsmIndexOfCoord(face.origin + uvec2(at), atlasWidth);
    if (matchTexel(AG_RSM_FETCH(texels, texel), place, normal).same) return texel;
    uint found = kNoTexel;
    float nearest = 1e30;
    for (int i = 0; i < 4; ++i) {
        vec2 corner = clamp(floor(at - 0.5) + vec2(i & 1, i >> 1), vec2(0.0), vec2(face.size - 1));
        texel = rsmIndexOfCoord(face.origin + uvec2(corner), atlasWidth);
        TexelMatch other = matchTexel(AG_RSM_FETCH(texels, texel), place, normal);
        if (!other.same || other.squared >= nearest) continue;
        nearest = other.squared;
        found = texel;
    }
    return found;
}
#endif
