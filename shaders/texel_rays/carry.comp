#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_control_flow_attributes : require
// The area lights' sum, corrected by what rays had found on the same surfaces while nothing changed. Where area lights send
// nothing, only what all lights have dimmed by tells that it no longer holds.
#include "common/pixel_rays.h"
#include "texel_rays/carried.glsl"
#include "texel_rays/texel_rays_io.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(push_constant, scalar) uniform Push { CarryPush p; } push;

layout(set = 0, binding = 0) uniform sampler2D normalMap;
layout(set = 0, binding = 1) uniform sampler2D depthMap;
layout(set = 0, binding = 2) uniform sampler2D areaLights;
layout(set = 0, binding = 3) uniform sampler2D previousCorrection;
layout(set = 0, binding = 4) uniform sampler2D previousSurface;
layout(set = 0, binding = 5, scalar) uniform Cameras { ReprojectionCameras c; } cameras;
layout(set = 0, binding = 6, rgba16f) uniform writeonly image2D irradiance;
layout(set = 0, binding = 7, rgba16f) uniform writeonly image2D correction;  // as in correct.comp
layout(set = 0, binding = 8, rgba16f) uniform writeonly image2D surface;     // normal; m along the axis, 0: sky

#include "ray_filter/before.glsl"

void main() {
    ivec2 size = imageSize(irradiance), pixel = ivec2(gl_GlobalInvocationID.xy), at = min(pixel, size - 1);
    float reversed = texelFetch(depthMap, at, 0).x, depth = reversed > 0.0 ? push.p.near / reversed : 0.0;
    vec3 normal = texelFetch(normalMap, at, 0).xyz, place = placeOf(cameras.c.now, vec2(at), depth) + cameras.c.now.eye;
    vec4 lights = texelFetch(areaLights, at, 0), c = vec4(0.0);
    if (push.p.valid == 1) {
        Before b = seenBefore(size, normal, place, depth);
        [[unroll]] for (int i = 0; i < 4; ++i) c += b.weights[i] * texelFetch(previousCorrection, b.taps[i], 0);
    }
    c *= push.p.dimming;
    c.rgb *= stillTrue(luminance(lights.rgb), c.a);
    if (any(greaterThanEqual(pixel, size))) return;
    imageStore(irradiance, pixel, vec4(clamp(lights.rgb + c.rgb, vec3(0.0), vec3(kMostHalf)), 0.0));
    imageStore(correction, pixel, c);
    imageStore(surface, pixel, vec4(normal, depth));
}
