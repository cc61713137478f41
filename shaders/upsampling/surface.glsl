// What passes know of a pixel's surface and of the gathered pixels, cells, about it.
#include "upsampling/upsampling_io.h"

layout(set = 0, binding = 0) uniform sampler2D normalMap;
layout(set = 0, binding = 1) uniform sampler2D depthMap;
layout(set = 0, binding = 2) uniform sampler2D cellNormals;
layout(set = 0, binding = 3) uniform sampler2D cellDepths;
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
    ivec2 there = clamp(cell, ivec2(0), textureSize(cellDepths, 0) - 1);
    int spacing = int(push.p.spacing);
    Surface other = surfaceAt(there * spacing + ivec2(push.p.place), texelFetch(cellDepths, there, 0).x,
                              texelFetch(cellNormals, there, 0).xyz);
    float like = likeness(s.normal, other.place - s.place, push.p.footprint * s.depth, other.normal);
    return other.depth > 0.0 ? like : 0.0;
}

// In cells.
vec2 cellsAt(ivec2 pixel) { return (vec2(pixel) - vec2(push.p.place)) / float(push.p.spacing); }
