// Surfaces as the denoiser compares them: normal and depth along the axis in one texel.
#ifndef AG_DENOISER_SURFACE_GLSL
#define AG_DENOISER_SURFACE_GLSL

#include "common/sampling.h"
#include "denoiser/denoiser_io.h"

// Relative to the eye, m.
vec3 placeOf(PixelRays rays, vec2 pixel, float depth) {
    return depth * (rays.corner + pixel.x * rays.right + pixel.y * rays.down);
}

// 1 on one plane and facing one way, else less. `apart`: m between two surface points; `footprint`: m a pixel covers.
float likeness(vec3 normal, vec3 apart, float footprint, vec3 otherNormal) {
    float off = dot(normal, apart) / footprint, facing = max(dot(normal, otherNormal), 0.0);
    float f2 = facing * facing, f8 = f2 * f2 * f2 * f2;
    return f8 * f8 / (1.0 + off * off * off * off);
}

// To half floats, up or down by chance, so that means over many frames stay true: some devices cut off, and what is lost
// in a history is lost again in each frame. `seed` differs from frame to frame.
vec3 roundedByChance(vec3 v, ivec2 pixel, uint seed) {
    uint r = hashUint(uint(pixel.x) + uint(pixel.y) * 8192u + seed * 67108864u + (seed >> 6));
    uvec3 bits = floatBitsToUint(max(v, vec3(0.0))) + (uvec3(r, r >> 9, r >> 18) & 0x1fffu);
    return uintBitsToFloat(bits & 0xffffe000u);
}

float luminance(vec3 c) { return dot(c, vec3(0.2126, 0.7152, 0.0722)); }

// Of a new sample, what does not stand out of three deviations of noise above its pixel's history.
float keptShare(float sampleLuminance, vec4 history, float noise) {
    float known = history.a > 0.0 ? luminance(history.rgb) : 0.0, most = known + 3.0 * noise;
    return known > 0.0 && sampleLuminance > most ? most / sampleLuminance : 1.0;
}
#endif
