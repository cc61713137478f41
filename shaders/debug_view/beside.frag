#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Our picture and another of the same view: one beside the other, or how far they are apart.
#include "common/tonemap.h"
#include "exposure/exposure_io.h"

const uint kBeside = 0;  // ours to the left of the split, the other to the right
const uint kError = 1;   // red brighter than the other, blue darker, full at its mean
layout(constant_id = 0) const bool kMetered = false;

layout(push_constant, scalar) uniform Push {
    float exposure;    // factor, 2^stops
    uint mode;         // see applyTonemap
    uint show;
    float split;       // pixels from the left
    float otherUnit;   // of the other's numbers, in ours
    float otherMean;   // in our unit
} push;

layout(set = 0, binding = 0) uniform sampler2D oursDisplay;
layout(set = 0, binding = 1) uniform sampler2D oursRadiance;
layout(set = 0, binding = 2) uniform sampler2D otherRadiance;
layout(set = 0, binding = 3, scalar) readonly buffer Metered { Exposure exposure; } metered;
layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 display;

float mean(vec3 v) { return (v.x + v.y + v.z) / 3.0; }

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    vec3 other = texelFetch(otherRadiance, at, 0).rgb * push.otherUnit;
    vec3 color = texelFetch(oursDisplay, at, 0).rgb;
    if (push.show == kError) {
        vec3 ours = texelFetch(oursRadiance, at, 0).rgb;
        float share = clamp(mean(ours - other) / max(push.otherMean, 1e-30), -1.0, 1.0);
        // Small errors shall be seen.
        color = (share > 0.0 ? vec3(1.0, 0.25, 0.1) : vec3(0.15, 0.4, 1.0)) * sqrt(abs(share));
    } else if (gl_FragCoord.x > push.split) {
        float exposure = kMetered ? exp2(metered.exposure.stops) : push.exposure;
        color = applyTonemap(other, exposure, push.mode);
        if (gl_FragCoord.x < push.split + 1.0) color = vec3(1.0);
    }
    display = vec4(color, 1.0);
}
