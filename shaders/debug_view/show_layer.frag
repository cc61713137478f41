#version 460
#extension GL_GOOGLE_include_directive : require
// A layer for the eye: light tonemapped, directions and depth as colours. Scales the layer to the target.
#include "common/false_color.h"
#include "common/tonemap.h"

const uint kLight = 0;      // tonemapped with the exposure
const uint kReflectance = 1;  // sRGB-encoded as it is
const uint kDirection = 2;  // -1..1 to 0..1
const uint kDistance = 3;   // metres on a logarithmic ramp
const uint kDisplay = 4;    // already display values
layout(constant_id = 0) const uint kShow = kLight;

layout(push_constant) uniform Push {
    float exposure;
    uint mode;
} push;
layout(set = 0, binding = 0) uniform sampler2D layer;
layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 display;

void main() {
    vec3 value = texelFetch(layer, ivec2(uv * vec2(textureSize(layer, 0))), 0).rgb;
    vec3 color = value;
    if (kShow == kLight) color = applyTonemap(value, push.exposure, push.mode);
    if (kShow == kReflectance) color = srgbFromLinear(value);
    if (kShow == kDirection) color = value * 0.5 + 0.5;
    if (kShow == kDistance) color = value.x > 0.0 ? heat(clamp(log2(value.x + 1.0) / 6.0, 0.0, 1.0)) : vec3(0.0);
    display = vec4(color, 1.0);
}
