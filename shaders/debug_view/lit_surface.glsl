// Finding the RSM texel that lights a surface point, for views that draw clusters over the scene.
#ifndef AG_LIT_SURFACE_GLSL
#define AG_LIT_SURFACE_GLSL

#include "common/texels.glsl"
#include "rsm/rsm.glsl"

layout(set = 0, binding = 0) VEC4_TEXELS(texels);
layout(set = 0, binding = 1, scalar) uniform Faces { RsmFace items[kMaxRsmFaces]; } faces;

// Index of the emitter at `position`, ~0 if no face sees that point.
uint findTexel(vec3 position, uint faceCount, uvec2 atlasSize) {
    uint found = 0xffffffffu;
    for (uint i = 0; i < faceCount; ++i) {
        vec4 clip = faces.items[i].clipFromWorld * vec4(position, 1.0);
        vec2 at = clip.xy / clip.w * 0.5 + 0.5;
        if (clip.w <= 0.0 || any(lessThan(at, vec2(0.0))) || any(greaterThanEqual(at, vec2(1.0)))) continue;
        uvec2 coord = faces.items[i].origin + uvec2(at * float(faces.items[i].size));
        uint index = rsmIndexOfCoord(coord, atlasSize.x);
        RsmSurface s = AG_RSM_FETCH(texels, index);
        vec3 d = s.position - position;
        if (s.weight > 0.0 && dot(d, d) < 4.0 * s.area) found = index;
    }
    return found;
}
#endif
