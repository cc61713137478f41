// What both passes know of a pixel's surface and of the gathered pixels about it.
#include "upsampling/upsampling_io.h"

layout(set = 0, binding = 0) uniform sampler2D normalMap;
layout(set = 0, binding = 1) uniform sampler2D depthMap;
layout(set = 0, binding = 2) uniform sampler2D light;  // of gathered pixels
layout(push_constant, scalar) uniform Push { UpsamplingPush p; } push;

struct Surface {
    vec3 place;   // relative to the eye, m
    vec3 normal;
    float depth;  // m along the camera's axis; 0: sky
};

Surface surfaceAt(ivec2 pixel) {
    float reversed = texelFetch(depthMap, pixel, 0).x, depth = reversed > 0.0 ? push.p.near / reversed : 0.0;
    return Surface(placeOf(push.p.rays, vec2(pixel), depth), texelFetch(normalMap, pixel, 0).xyz, depth);
}

// Of a gathered pixel's surface with `s`; beyond the image's border there is none.
float likenessOf(Surface s, ivec2 cell) {
    ivec2 last = textureSize(light, 0) - 1, size = textureSize(depthMap, 0);
    int step = int(push.p.step);
    Surface other = surfaceAt(min(clamp(cell, ivec2(0), last) * step + step / 2, size - 1));
    float like = likeness(s.normal, other.place - s.place, push.p.footprint * s.depth, other.normal);
    return other.depth > 0.0 ? like : 0.0;
}

// In gathered pixels.
vec2 cellsAt(ivec2 pixel) { return (vec2(pixel) - float(push.p.step / 2)) / float(push.p.step); }
