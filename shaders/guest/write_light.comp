#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Light into an image of the host's, in its units: bounced and of the sky; black where there is none.
#include "guest/guest_io.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const bool kLit = false;
layout(constant_id = 1) const bool kSky = false;
layout(push_constant, scalar) uniform Push { float scale; } push;
layout(set = 0, binding = 0) uniform sampler2D light;
layout(set = 0, binding = 1) uniform sampler2D sky;
layout(set = 0, binding = 2, rgba16f) uniform writeonly image2D result;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(result)))) return;
    vec3 value = kLit ? texelFetch(light, pixel, 0).rgb : vec3(0.0);
    if (kSky) value += texelFetch(sky, pixel, 0).rgb;
    imageStore(result, pixel, vec4(min(value * push.scale, vec3(kMostHalf)), 1.0));
}
