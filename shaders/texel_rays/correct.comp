#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_control_flow_attributes : require
// The area lights' sum, corrected by what the rays found, as far as that stands out of its noise (the positive part of James
// and Stein's estimator, over the pixels about). Until it does, by what rays had found before something changed.
#include "common/pixel_rays.h"
#include "ray_filter/shrinkage.glsl"
#include "texel_rays/carried.glsl"
#include "texel_rays/texel_rays_io.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0) uniform sampler2D areaLights;
layout(set = 0, binding = 1) uniform sampler2D rest;
layout(set = 0, binding = 2) uniform sampler2D shareOf;
layout(set = 0, binding = 3, rgba16f) uniform writeonly image2D irradiance;  // a: standard deviation of its noise
layout(set = 0, binding = 4) uniform sampler2D previousCarried;
// rgb: what was added to the area lights' light, W/m²; a: its luminance then.
layout(set = 0, binding = 5, rgba16f) uniform writeonly image2D correction;
layout(set = 0, binding = 6, rgba16f) uniform writeonly image2D carried;  // that from before the last change
layout(set = 0, binding = 7) uniform sampler2D surface;  // normal; m along the axis, 0: sky
layout(set = 0, binding = 8) uniform sampler2D previousSurface;
layout(set = 0, binding = 9, scalar) uniform Cameras { ReprojectionCameras c; } cameras;
layout(set = 0, binding = 10) uniform sampler2D motionMap;  // m to where the surface was; read only if kMotion
layout(constant_id = 0) const bool kMotion = false;
layout(push_constant, scalar) uniform Push { CorrectPush p; } push;
#include "ray_filter/before.glsl"

const int kStride = 4;     // pixels

vec3 correctionAt(ivec2 at, vec3 lights, vec3 left) { return left + (texelFetch(shareOf, at, 0).x - 1.0) * lights; }

// What was carried to the frame before, on the surface seen here.
vec4 knownAt(ivec2 at, ivec2 size) {
    if (push.p.moving == 0) return texelFetch(previousCarried, at, 0);
    vec4 s = texelFetch(surface, at, 0), known = vec4(0.0);
    vec3 motion = kMotion ? texelFetch(motionMap, at, 0).xyz : vec3(0.0);
    Before b = seenBefore(size, s.xyz, placeOf(cameras.c.now, vec2(at), s.w) + cameras.c.now.eye + motion, s.w);
    [[unroll]] for (int i = 0; i < 4; ++i) known += b.weights[i] * texelFetch(previousCarried, b.taps[i], 0);
    return known;
}

void main() {
    ivec2 size = imageSize(irradiance), pixel = ivec2(gl_GlobalInvocationID.xy), at = min(pixel, size - 1);
    float found = 0.0, noise = 0.0;
    [[unroll]] for (int y = -1; y <= 1; ++y)
        [[unroll]] for (int x = -1; x <= 1; ++x) {
            ivec2 there = clamp(at + ivec2(x, y) * kStride, ivec2(0), size - 1);
            vec4 r = texelFetch(rest, there, 0);
            vec3 c = correctionAt(there, texelFetch(areaLights, there, 0).rgb, r.rgb);
            found += meanProduct(c, c), noise += r.a;
        }
    vec4 lights = texelFetch(areaLights, at, 0), known = knownAt(at, size);
    vec3 measured = correctionAt(at, lights.rgb, texelFetch(rest, at, 0).rgb);
    float trust = trustIn(found, noise);
    vec4 kept = push.p.valid == 1 ? vec4(push.p.fading * stillTrue(luminance(lights.rgb), known.a) * known.rgb, known.a) : vec4(0.0);
    vec3 c = mix(kept.rgb, measured, trust);
    if (any(greaterThanEqual(pixel, size))) return;
    float deviation = trust * sqrt(kDoubt * texelFetch(rest, at, 0).a);
    imageStore(irradiance, pixel, vec4(clamp(lights.rgb + c, vec3(0.0), vec3(kMostHalf)), min(deviation, kMostHalf)));
    imageStore(correction, pixel, vec4(c, luminance(lights.rgb)));
    imageStore(carried, pixel, kept);
}
