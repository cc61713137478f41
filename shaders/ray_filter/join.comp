#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_control_flow_attributes : require
// Each turn filters its own pixels alone, so neighbours of different turns differ by noise, in a grid of dots. One more
// round of the filter over all pixels.
#include "common/pixel_rays.h"
#include "ray_filter/ray_filter_io.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(push_constant, scalar) uniform Push { JoinPush p; } push;

layout(set = 0, binding = 0) uniform sampler2D normalMap;
layout(set = 0, binding = 1) uniform sampler2D depthMap;
layout(set = 0, binding = 2) uniform sampler2D light;  // a: standard deviation of its noise
layout(set = 0, binding = 3, rgba16f) uniform writeonly image2D result;

vec4 surfaceOf(ivec2 at) {
    float reversed = texelFetch(depthMap, at, 0).x;
    return vec4(texelFetch(normalMap, at, 0).xyz, reversed > 0.0 ? push.p.near / reversed : 0.0);
}
vec4 lightOf(ivec2 at) {
    vec4 l = texelFetch(light, at, 0);
    return vec4(l.rgb, l.a * l.a);
}
#include "ray_filter/filter.glsl"

void main() {
    ivec2 size = imageSize(result), pixel = ivec2(gl_GlobalInvocationID.xy), at = min(pixel, size - 1);
    vec4 mean = filtered(at, size, push.p.rays, length(push.p.rays.down), push.p.filterBy);
    if (all(lessThan(pixel, size))) imageStore(result, pixel, vec4(mean.rgb, sqrt(mean.a)));
}
