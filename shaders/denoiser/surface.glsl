// Surfaces as the denoiser compares them: normal and depth along the axis in one texel.
#ifndef AG_DENOISER_SURFACE_GLSL
#define AG_DENOISER_SURFACE_GLSL

#include "common/pixel_rays.h"
#include "common/sampling.h"
#include "denoiser/denoiser_io.h"

// To half floats, up or down by chance, so that means over many frames stay true: some devices cut off, and what is lost
// in a history is lost again in each frame. `seed` differs from frame to frame.
vec3 roundedByChance(vec3 v, ivec2 pixel, uint seed) {
    uint r = hashUint(uint(pixel.x) + uint(pixel.y) * 8192u + seed * 67108864u + (seed >> 6));
    uvec3 bits = floatBitsToUint(max(v, vec3(0.0))) + (uvec3(r, r >> 9, r >> 18) & 0x1fffu);
    return uintBitsToFloat(bits & 0xffffe000u);
}

// Of a new sample, what does not stand out of three deviations of noise above its pixel's history.
float keptShare(float sampleLuminance, vec4 history, float noise) {
    float known = history.a > 0.0 ? luminance(history.rgb) : 0.0, most = known + 3.0 * noise;
    return known > 0.0 && sampleLuminance > most ? most / sampleLuminance : 1.0;
}
#endif
