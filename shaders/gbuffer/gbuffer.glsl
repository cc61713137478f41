// Reading the G-buffer: surface position and normal of a pixel.
#ifndef AG_GBUFFER_GLSL
#define AG_GBUFFER_GLSL

#include "scene/scene_io.h"

// World position of a pixel centre, from reversed depth (0 at infinity).
vec3 worldFromPixel(mat4 worldFromClip, uvec2 size, ivec2 pixel, float depth) {
    vec2 ndc = (vec2(pixel) + 0.5) / vec2(size) * 2.0 - 1.0;
    vec4 h = worldFromClip * vec4(ndc, max(depth, 1e-9), 1.0);
    return h.xyz / h.w;
}
#endif
