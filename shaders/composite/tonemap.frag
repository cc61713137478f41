#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Display image: exposure, tone curve, sRGB encoding, dither.
#include "common/tonemap.h"
#include "exposure/exposure_io.h"

layout(constant_id = 0) const bool kMetered = false;
layout(constant_id = 1) const uint kCurve = 0;  // see applyTonemap: the others are compiled out

layout(constant_id = 2) const bool kDither = false;

layout(push_constant, scalar) uniform Push {
    float exposure;  // factor, 2^stops
} push;

layout(set = 0, binding = 0) uniform sampler2D radianceMap;
layout(set = 0, binding = 1, scalar) readonly buffer Metered { Exposure exposure; } metered;
layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 display;

// 0 to 1, even over any few pixels: interleaved gradient noise (Jimenez 2014).
float evenNoise(vec2 pixel) { return fract(52.9829189 * fract(dot(pixel, vec2(0.06711056, 0.00583715)))); }

void main() {
    vec3 radiance = texelFetch(radianceMap, ivec2(gl_FragCoord.xy), 0).rgb;
    float exposure = kMetered ? exp2(metered.exposure.stops) : push.exposure;
    vec3 shown = applyTonemap(radiance, exposure, kCurve);
    if (kDither) shown += (evenNoise(gl_FragCoord.xy) - 0.5) / 255.0;
    display = vec4(shown, 1.0);
}
