// A texel's square of its map, as seen from a place through the texel's plane. Needs the buffers of rsm/footprint.glsl.
#ifndef AG_TEXEL_SQUARE_GLSL
#define AG_TEXEL_SQUARE_GLSL

#include "common/rsm_math.h"
#include "rsm/footprint.glsl"

// Of the square on the texel's plane, m², as if it were everywhere as large as about `place`. `ndc`: of that place.
float areaOfSquare(TexelView v, vec3 place, vec2 ndc) {
    bool sun = v.map.kind == kLightDirectional;
    vec3 d = place - v.map.position, away = sun ? v.map.direction : normalize(d);
    float tanHalf = v.map.tanHalf, resolution = float(v.face.size);
    float cosAxis = inversesqrt(1.0 + dot(ndc, ndc) * tanHalf * tanHalf);
    float across = sun ? orthoTexelArea(2.0 * tanHalf, resolution)
                       : perspectiveTexelSolidAngle(tanHalf, resolution, cosAxis) * dot(d, d);
    return across / max(-dot(away, v.s.normal), 1e-6);
}

// Where a direction crosses the texel's plane.
struct SquareCrossing {
    float density;  // of the direction, 1/sr, if places of the square are drawn evenly; 0: it crosses from behind
    vec2 aside;     // of the texel's middle, texels
};

SquareCrossing crossSquare(TexelView v, vec3 from, vec3 direction) {
    float height = dot(from - v.s.position, v.s.normal), cosine = -dot(direction, v.s.normal);
    float along = height / max(cosine, 1e-9);
    vec3 place = from + direction * along;
    vec4 clip = v.face.clipFromWorld * vec4(place, 1.0);
    vec2 ndc = clip.xy / max(clip.w, 1e-9);
    float density = along * along / (areaOfSquare(v, place, ndc) * max(cosine, 1e-9));
    bool faces = height > 0.0 && cosine > 0.0 && clip.w > 0.0;
    return SquareCrossing(faces ? density : 0.0, (ndc - v.ndc.xy) * (0.5 * float(v.face.size)));
}

bool inSquare(vec2 aside) { return all(lessThanEqual(abs(aside), vec2(0.5))); }
#endif
