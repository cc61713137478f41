#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Display image: exposure, tone curve, sRGB encoding.
#include "common/tonemap.h"

layout(push_constant, scalar) uniform Push {
    float exposure;  // factor, 2^stops
    uint mode;       // 0 none, 1 Reinhard, 2 ACES-like
} push;

layout(set = 0, binding = 0) uniform sampler2D radianceMap;
layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 display;

void main() {
    vec3 radiance = texelFetch(radianceMap, ivec2(gl_FragCoord.xy), 0).rgb;
    display = vec4(applyTonemap(radiance, push.exposure, push.mode), 1.0);
}
