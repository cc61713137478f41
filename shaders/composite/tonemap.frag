#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Display image: exposure, tone curve, sRGB encoding.
#include "common/tonemap.h"
#include "exposure/exposure_io.h"

layout(constant_id = 0) const bool kMetered = false;
layout(constant_id = 1) const uint kCurve = 0;  // see applyTonemap: the others are compiled out

layout(push_constant, scalar) uniform Push {
    float exposure;  // factor, 2^stops
} push;

layout(set = 0, binding = 0) uniform sampler2D radianceMap;
layout(set = 0, binding = 1, scalar) readonly buffer Metered { Exposure exposure; } metered;
layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 display;

void main() {
    vec3 radiance = texelFetch(radianceMap, ivec2(gl_FragCoord.xy), 0).rgb;
    float exposure = kMetered ? exp2(metered.exposure.stops) : push.exposure;
    display = vec4(applyTonemap(radiance, exposure, kCurve), 1.0);
}
