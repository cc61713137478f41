#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_control_flow_attributes : require
// One round over what rays found.
#include "common/pixel_rays.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0) uniform sampler2D rest;
layout(set = 0, binding = 1) uniform sampler2D surface;
layout(set = 0, binding = 2, scalar) uniform Cameras { ReprojectionCameras c; } cameras;
layout(set = 0, binding = 3, rgba32f) uniform writeonly image2D result;

vec4 surfaceOf(ivec2 at) { return texelFetch(surface, at, 0); }
vec4 lightOf(ivec2 at) { return texelFetch(rest, at, 0); }
#include "ray_filter/filter.glsl"

layout(push_constant, scalar) uniform Push { RayFilterPush p; } push;
layout(constant_id = 0) const bool kDeviation = false;  // the result's alpha, else variance

void main() {
    ivec2 size = imageSize(result), pixel = ivec2(gl_GlobalInvocationID.xy), at = min(pixel, size - 1);
    vec4 mean = filtered(at, size, cameras.c.now, cameras.c.pixelSize, push.p);
    if (all(lessThan(pixel, size))) imageStore(result, pixel, vec4(mean.rgb, kDeviation ? sqrt(mean.a) : mean.a));
}
