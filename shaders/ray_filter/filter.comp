#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_control_flow_attributes : require
// One round of an edge-avoiding à-trous filter (Dammertz et al. 2010) that knows its variance (Schied et al. 2017): over pixels
// on the same surface whose light differs by no more than noise.
#include "common/pixel_rays.h"
#include "ray_filter/ray_filter_io.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(push_constant, scalar) uniform Push { RayFilterPush p; } push;

layout(set = 0, binding = 0) uniform sampler2D rest;
layout(set = 0, binding = 1) uniform sampler2D surface;
layout(set = 0, binding = 2, scalar) uniform Cameras { ReprojectionCameras c; } cameras;
layout(set = 0, binding = 3, rgba32f) uniform writeonly image2D result;

const float kSpline[3] = float[](0.375, 0.25, 0.0625);

void main() {
    ivec2 size = imageSize(result), pixel = ivec2(gl_GlobalInvocationID.xy), at = min(pixel, size - 1);
    vec4 s = texelFetch(surface, at, 0), here = texelFetch(rest, at, 0);
    vec3 place = placeOf(cameras.c.now, vec2(at), s.w);
    float footprint = cameras.c.pixelSize * max(s.w, 1e-3) * 2.0, l = luminance(here.rgb);
    vec4 sum = vec4(0.0);
    float total = 0.0;
    [[unroll]] for (int y = -2; y <= 2; ++y)
        [[unroll]] for (int x = -2; x <= 2; ++x) {
            ivec2 tap = at + ivec2(x, y) * push.p.stride, there = clamp(tap, ivec2(0), size - 1);
            vec4 other = texelFetch(surface, there, 0), r = texelFetch(rest, there, 0);
            float like = likeness(s.xyz, placeOf(cameras.c.now, vec2(there), other.w) - place, footprint, other.xyz);
            float off = luminance(r.rgb) - l, allowed = push.p.tolerance * push.p.tolerance * (here.a + r.a) + 1e-20;
            float weight = kSpline[abs(x)] * kSpline[abs(y)] * like / (1.0 + off * off / allowed);
            weight = tap == there && other.w > 0.0 ? weight : 0.0;
            sum += vec4(weight * r.rgb, weight * weight * r.a);
            total += weight;
        }
    vec4 mean = s.w > 0.0 && total > 0.0 ? vec4(sum.rgb / total, sum.a / (total * total)) : vec4(0.0);
    if (all(lessThan(pixel, size))) imageStore(result, pixel, mean);
}
