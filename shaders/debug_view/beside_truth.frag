#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Our picture and the path tracer's: one beside the other, or how far they are apart.
#include "common/tonemap.h"
#include "exposure/exposure_io.h"

const uint kBeside = 0;  // ours to the left of the split, the truth to the right
const uint kError = 1;   // red too bright, blue too dark, full at the truth's mean
layout(constant_id = 0) const bool kMetered = false;

layout(push_constant, scalar) uniform Push {
    float exposure;    // factor, 2^stops
    uint mode;         // see applyTonemap
    uint show;
    float split;       // pixels from the left
    float light;       // W/(m² sr) of one unit of ours
    float meanOfTruth; // W/(m² sr)
} push;

layout(set = 0, binding = 0) uniform sampler2D oursDisplay;
layout(set = 0, binding = 1) uniform sampler2D oursRadiance;  // in units
layout(set = 0, binding = 2) uniform sampler2D truth;         // W/(m² sr)
layout(set = 0, binding = 3, scalar) readonly buffer Metered { Exposure exposure; } metered;
layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 display;

float mean(vec3 v) { return (v.x + v.y + v.z) / 3.0; }

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    vec3 right = texelFetch(truth, at, 0).rgb;
    vec3 color = texelFetch(oursDisplay, at, 0).rgb;
    if (push.show == kError) {
        vec3 ours = texelFetch(oursRadiance, at, 0).rgb * push.light;
        float share = clamp(mean(ours - right) / max(push.meanOfTruth, 1e-30), -1.0, 1.0);
        // Small errors shall be seen.
        color = (share > 0.0 ? vec3(1.0, 0.25, 0.1) : vec3(0.15, 0.4, 1.0)) * sqrt(abs(share));
    } else if (gl_FragCoord.x > push.split) {
        float exposure = kMetered ? exp2(metered.exposure.stops) : push.exposure;
        color = applyTonemap(right / push.light, exposure, push.mode);
        if (gl_FragCoord.x < push.split + 1.0) color = vec3(1.0);
    }
    display = vec4(color, 1.0);
}
