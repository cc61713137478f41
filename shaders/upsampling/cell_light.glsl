// Light of the gathered pixels, cells, and what it is added to.
#include "upsampling/surface.glsl"

layout(set = 0, binding = 4) uniform sampler2D light;  // of cells
layout(set = 0, binding = 8) uniform sampler2D toward;  // of cells: relative vector irradiance
layout(set = 0, binding = 9) uniform sampler2D base;    // of pixels: other light that this is added to
layout(constant_id = 0) const bool kDirected = false;
layout(constant_id = 1) const bool kAdd = false;

vec4 withBase(ivec2 pixel, vec4 e) { return kAdd ? vec4(e.rgb + texelFetch(base, pixel, 0).rgb, e.a) : e; }

// A cell's light as a surface that is turned otherwise takes it.
vec4 lightFor(Surface s, ivec2 cell) {
    const float kLeast = 0.5, kMost = 1.5;  // light that comes over the horizon, or no longer does, is not known
    ivec2 there = clamp(cell, ivec2(0), textureSize(light, 0) - 1);
    vec4 e = texelFetch(light, there, 0);
    if (!kDirected) return e;
    vec3 from = texelFetch(toward, there, 0).xyz;
    float own = dot(from, texelFetch(cellNormals, there, 0).xyz);
    return own > 0.0 ? vec4(e.rgb * clamp(dot(from, s.normal) / own, kLeast, kMost), e.a) : e;
}
