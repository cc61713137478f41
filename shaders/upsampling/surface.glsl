// What both passes know of a pixel's surface and of the gathered pixels, cells, about it.
#include "upsampling/upsampling_io.h"

layout(set = 0, binding = 0) uniform sampler2D normalMap;
layout(set = 0, binding = 1) uniform sampler2D depthMap;
layout(set = 0, binding = 2) uniform sampler2D cellNormals;
layout(set = 0, binding = 3) uniform sampler2D cellDepths;
layout(set = 0, binding = 4) uniform sampler2D light;  // of cells
layout(set = 0, binding = 8) uniform sampler2D toward;  // of cells: relative vector irradiance
layout(set = 0, binding = 9) uniform sampler2D base;    // of pixels: other light that this is added to
layout(constant_id = 0) const bool kDirected = false;
layout(constant_id = 1) const bool kAdd = false;
layout(push_constant, scalar) uniform Push { UpsamplingPush p; } push;

struct Surface {
    vec3 place;  // relative to the eye, m
    vec3 normal;
    float depth;  // m along the camera's axis; 0: sky
};

Surface surfaceAt(ivec2 pixel, float reversedDepth, vec3 normal) {
    float depth = reversedDepth > 0.0 ? push.p.near / reversedDepth : 0.0;
    return Surface(placeOf(push.p.rays, vec2(pixel), depth), normal, depth);
}

Surface surfaceAt(ivec2 pixel) {
    return surfaceAt(pixel, texelFetch(depthMap, pixel, 0).x, texelFetch(normalMap, pixel, 0).xyz);
}

// Of a cell's surface with `s`; beyond the image's border it is the last cell's.
float likenessOf(Surface s, ivec2 cell) {
    ivec2 there = clamp(cell, ivec2(0), textureSize(light, 0) - 1);
    int spacing = int(push.p.spacing);
    Surface other = surfaceAt(there * spacing + spacing / 2, texelFetch(cellDepths, there, 0).x,
                              texelFetch(cellNormals, there, 0).xyz);
    float like = likeness(s.normal, other.place - s.place, push.p.footprint * s.depth, other.normal);
    return other.depth > 0.0 ? like : 0.0;
}

vec3 withBase(ivec2 pixel, vec3 e) { return kAdd ? e + texelFetch(base, pixel, 0).rgb : e; }

// In cells.
vec2 cellsAt(ivec2 pixel) { return (vec2(pixel) - float(push.p.spacing / 2)) / float(push.p.spacing); }

// A cell's light as a surface that is turned otherwise takes it.
vec3 lightFor(Surface s, ivec2 cell) {
    const float kLeast = 0.5, kMost = 1.5;  // light that comes over the horizon, or no longer does, is not known
    ivec2 there = clamp(cell, ivec2(0), textureSize(light, 0) - 1);
    vec3 e = texelFetch(light, there, 0).rgb;
    if (!kDirected) return e;
    vec3 from = texelFetch(toward, there, 0).xyz;
    float own = dot(from, texelFetch(cellNormals, there, 0).xyz);
    return own > 0.0 ? e * clamp(dot(from, s.normal) / own, kLeast, kMost) : e;
}
