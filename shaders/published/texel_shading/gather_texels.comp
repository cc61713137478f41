#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// First-bounce irradiance: every pixel meets every RSM texel as a point emitter. Four pixels an invocation share
// the loads.
#include "common/form_factors.h"
#include "common/lane_loop.glsl"
#include "common/texels.glsl"
#include "gbuffer/gbuffer.glsl"

layout(local_size_x = 64) in;  // 16 x 16 pixels, a 2 x 2 block each
layout(constant_id = 0) const bool kFirst = true;  // starts from zero instead of adding
layout(push_constant, scalar) uniform Push { uint first, last; } push;  // texels, whole subgroups of them

layout(set = 0, binding = 0) uniform sampler2D normalMap;
layout(set = 0, binding = 1) uniform sampler2D depthMap;
layout(set = 0, binding = 2, scalar) uniform Camera { CameraConstants camera; } camera;
layout(set = 0, binding = 3) VEC4_TEXELS(texels);
layout(set = 0, binding = 4, rgba16f) uniform image2D irradiance;

const int kPixels = 4;

struct PointLight {
    vec3 place, normal, flux;
};

PointLight loadLight(uint index) {
    int at = int(index) * 3;
    return PointLight(fetchTexel(texels, at).xyz, fetchTexel(texels, at + 1).xyz, fetchTexel(texels, at + 2).xyz);
}

void accumulate(inout vec3 e[kPixels], vec3 x[kPixels], vec3 n[kPixels], PointLight l) {
    [[unroll]] for (int p = 0; p < kPixels; ++p) e[p] += l.flux * vplTerm(x[p], n[p], l.place, l.normal);
}

void main() {
    uvec2 size = camera.camera.size;
    uvec2 block = gl_WorkGroupID.xy * 16 + uvec2(gl_LocalInvocationID.x % 8, gl_LocalInvocationID.x / 8) * 2;
    vec3 x[kPixels], n[kPixels], e[kPixels];
    bool surface[kPixels];
    [[unroll]] for (int p = 0; p < kPixels; ++p) {
        ivec2 pixel = min(ivec2(block + uvec2(p & 1, p >> 1)), ivec2(size) - 1);
        float depth = texelFetch(depthMap, pixel, 0).x;
        surface[p] = depth > 0.0;
        x[p] = worldFromPixel(camera.camera.worldFromClip, size, pixel, depth);
        n[p] = texelFetch(normalMap, pixel, 0).xyz;
        e[p] = vec3(0.0);
    }
    if (kLaneParallel) {
        for (uint base = push.first; base < push.last; base += kSubgroupSize) {
            PointLight mine = loadLight(base + gl_SubgroupInvocationID);
            [[unroll]] for (uint lane = 0; lane < kSubgroupSize; ++lane)
                accumulate(e, x, n, PointLight(subgroupShuffle(mine.place, lane), subgroupShuffle(mine.normal, lane),
                                               subgroupShuffle(mine.flux, lane)));
        }
    } else {
        for (uint i = push.first; i < push.last; ++i) accumulate(e, x, n, loadLight(i));
    }
    [[unroll]] for (int p = 0; p < kPixels; ++p) {
        ivec2 pixel = ivec2(block + uvec2(p & 1, p >> 1));
        if (any(greaterThanEqual(pixel, ivec2(size)))) continue;
        vec3 sum = surface[p] ? e[p] : vec3(0.0);
        if (!kFirst) sum += imageLoad(irradiance, pixel).rgb;
        imageStore(irradiance, pixel, vec4(min(sum, vec3(kMostHalf)), 1.0));
    }
}
