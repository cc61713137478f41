#version 460
#extension GL_GOOGLE_include_directive : require
// An intermediate as plain floats in its own unit, for files and comparison.
const uint kLight = 0;
const uint kSum = 1;    // of two images, or three
const uint kDepth = 2;  // reversed depth to metres along the camera's axis; 0: no surface
const uint kDifference = 3;
layout(constant_id = 0) const uint kMode = kLight;
layout(constant_id = 1) const bool kThird = false;

layout(push_constant) uniform Push { float unit; } push;  // of light; with kDepth: m from the near plane
layout(set = 0, binding = 0) uniform sampler2D first;
layout(set = 0, binding = 1) uniform sampler2D second;
layout(set = 0, binding = 2) uniform sampler2D third;
layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 value;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec3 result = texelFetch(first, pixel, 0).rgb;
    if (kMode == kSum) result += texelFetch(second, pixel, 0).rgb;
    if (kThird) result += texelFetch(third, pixel, 0).rgb;
    if (kMode == kDifference) result -= texelFetch(second, pixel, 0).rgb;
    value = vec4(kMode == kDepth ? vec3(result.x > 0.0 ? push.unit / result.x : 0.0) : result * push.unit, 1.0);
}
