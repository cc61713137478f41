#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_control_flow_attributes : require
// Area lights' gloss, corrected by what gloss rays found, as far as that stands out of its noise (the positive part of James
// and Stein's estimator, over the pixels about). Once something changes no rays are cast, and what they had found on the surfaces
// fades, at once where the area lights' gloss is another.
#include "common/brdf.h"
#include "gloss_rays/gloss_rays_io.h"
#include "ray_filter/shrinkage.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(push_constant, scalar) uniform Push { GlossMixPush p; } push;

layout(set = 0, binding = 0) uniform sampler2D normalMap;
layout(set = 0, binding = 1) uniform sampler2D depthMap;
layout(set = 0, binding = 2) uniform sampler2D reflectanceMap;
layout(set = 0, binding = 3) uniform sampler2D albedoMap;
layout(set = 0, binding = 4) uniform sampler2D irradianceMap;
layout(set = 0, binding = 5) uniform sampler2D glossMap;   // of area lights
layout(set = 0, binding = 6) uniform sampler2D foundMap;   // by rays; read only if kRays
layout(set = 0, binding = 7) uniform sampler2D previousCarried;
layout(set = 0, binding = 8) uniform sampler2D previousSurface;
layout(set = 0, binding = 9, scalar) uniform Cameras { ReprojectionCameras c; } cameras;
layout(set = 0, binding = 10, rgba16f) uniform writeonly image2D gloss;       // W/(m² sr)
layout(set = 0, binding = 11, rgba16f) uniform writeonly image2D correction;  // of area lights' gloss; a: the luminance of that then
layout(set = 0, binding = 12, rgba16f) uniform writeonly image2D surface;     // normal; m along the axis, 0: sky
layout(set = 0, binding = 13, rgba16f) uniform writeonly image2D carried;     // of that, what is from before the last change
layout(constant_id = 0) const bool kRays = true;
#include "ray_filter/before.glsl"
#include "texel_rays/carried.glsl"

float depthAt(ivec2 pixel) {
    float reversed = texelFetch(depthMap, pixel, 0).x;
    return reversed > 0.0 ? push.p.near / reversed : 0.0;
}

// What the lobe reflects, less what it keeps from what is under it, over area lights' gloss.
vec3 measuredAt(ivec2 pixel) {
    vec4 reflectance = texelFetch(reflectanceMap, pixel, 0);
    if (reflectance.w <= 0.0) return vec3(0.0);
    float cosine = dot(texelFetch(normalMap, pixel, 0).xyz, -normalize(placeOf(push.p.rays, vec2(pixel), 1.0)));
    vec3 under = texelFetch(albedoMap, pixel, 0).rgb * texelFetch(irradianceMap, pixel, 0).rgb * kInvPi;
    vec3 byRays = texelFetch(foundMap, pixel, 0).rgb - meanFresnel(reflectance.rgb, vec3(reflectance.w), cosine) * under;
    return byRays - texelFetch(glossMap, pixel, 0).rgb;
}

float trustAbout(ivec2 pixel, ivec2 size) {
    float found = 0.0, noise = 0.0;
    [[unroll]] for (int y = -1; y <= 1; ++y)
        [[unroll]] for (int x = -1; x <= 1; ++x) {
            ivec2 there = clamp(pixel + ivec2(x, y) * push.p.stride, ivec2(0), size - 1);
            vec3 c = measuredAt(there);
            float deviation = texelFetch(foundMap, there, 0).a;
            found += meanProduct(c, c), noise += deviation * deviation;
        }
    return push.p.trust * trustIn(found, noise);
}

void main() {
    ivec2 size = imageSize(gloss), pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, size))) return;
    float depth = depthAt(pixel), trust = 0.0;
    vec3 normal = texelFetch(normalMap, pixel, 0).xyz, byLights = texelFetch(glossMap, pixel, 0).rgb, fromEye = placeOf(push.p.rays, vec2(pixel), depth);
    float bright = luminance(abs(byLights));
    vec4 kept = vec4(0.0);
    if (push.p.valid == 1) {
        Before b = seenBefore(size, normal, fromEye + cameras.c.now.eye, depth);
        [[unroll]] for (int i = 0; i < 4; ++i) kept += b.weights[i] * texelFetch(previousCarried, b.taps[i], 0);
    }
    kept.rgb *= push.p.fading * stillTrue(bright, kept.a);
    if (kRays && depth > 0.0) trust = trustAbout(pixel, size);
    vec3 most = vec3(kMostHalf), c = clamp(trust > 0.0 ? mix(kept.rgb, measuredAt(pixel), trust) : kept.rgb, -most, most);
    imageStore(gloss, pixel, vec4(clamp(byLights + c, -most, most), 0.0));
    imageStore(correction, pixel, vec4(c, min(bright, kMostHalf)));
    imageStore(carried, pixel, kept);
    imageStore(surface, pixel, vec4(normal, depth));
}
