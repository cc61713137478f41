#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// First-bounce irradiance: every pixel meets every virtual area light. Four pixels an invocation share the loads.
#include "common/form_factors.h"
#include "common/lane_loop.glsl"
#include "gbuffer/gbuffer.glsl"
#include "val_fit/val_fit_io.h"

layout(local_size_x = 64) in;  // 16 x 16 pixels, a 2 x 2 block each

const uint kShapePoint = 0;
const uint kShapeDisk = 1;        // as published: RSMC eq. 2
const uint kShapeVectorDisk = 2;  // closed form of a disk's vector irradiance
layout(constant_id = 0) const uint kShape = kShapeVectorDisk;

layout(constant_id = 1) const bool kFirst = true;  // starts from zero instead of adding
layout(push_constant, scalar) uniform Push { uint first, last; } push;  // lights, whole subgroups of them

layout(set = 0, binding = 0) uniform sampler2D normalMap;
layout(set = 0, binding = 1) uniform sampler2D depthMap;
layout(set = 0, binding = 2, scalar) readonly buffer Camera { CameraConstants camera; } camera;
layout(set = 0, binding = 3) uniform samplerBuffer vals;
layout(set = 0, binding = 4, rgba16f) uniform image2D irradiance;

const int kPixels = 4;

// With flux premultiplied by what the shape leaves constant: see loadVal.
float shapeTerm(vec3 x, vec3 n, vec4 a, vec3 valNormal) {
    if (kShape == kShapePoint) return vplTerm(x, n, a.xyz, valNormal);
    if (kShape == kShapeDisk) return diskPublishedTerm(x, n, a.xyz, valNormal, a.w);
    return diskVectorFactor(x, n, a.xyz, valNormal, a.w);
}

void loadVal(int index, out vec4 a, out vec3 normal, out vec3 flux) {
    a = texelFetch(vals, index * 3);
    normal = texelFetch(vals, index * 3 + 1).xyz;
    flux = texelFetch(vals, index * 3 + 2).xyz;
    if (kShape != kShapeVectorDisk) return;
    flux /= a.w;      // radiosity
    a.w *= kInvPi;    // radius²
}

void accumulate(inout vec3 e[kPixels], vec3 x[kPixels], vec3 n[kPixels], vec4 a, vec3 valNormal, vec3 flux) {
    [[unroll]] for (int p = 0; p < kPixels; ++p) e[p] += flux * shapeTerm(x[p], n[p], a, valNormal);
}

ivec2 pixelOf(int p) {
    uvec2 block = uvec2(gl_LocalInvocationID.x % 8, gl_LocalInvocationID.x / 8) * 2;
    return ivec2(gl_WorkGroupID.xy * 16 + block + uvec2(p & 1, p >> 1));
}

void main() {
    uvec2 size = camera.camera.size;
    mat4 worldFromClip = camera.camera.worldFromClip;
    vec3 x[kPixels], n[kPixels], e[kPixels];
    bool surface[kPixels];
    [[unroll]] for (int p = 0; p < kPixels; ++p) {
        ivec2 pixel = min(pixelOf(p), ivec2(size) - 1);
        float depth = texelFetch(depthMap, pixel, 0).x;
        surface[p] = depth > 0.0;
        x[p] = worldFromPixel(worldFromClip, size, pixel, depth);
        n[p] = texelFetch(normalMap, pixel, 0).xyz;
        e[p] = vec3(0.0);
    }
    if (kLaneParallel) {
        for (uint base = push.first; base < push.last; base += kSubgroupSize) {
            vec4 a;
            vec3 valNormal, flux;
            loadVal(int(base + gl_SubgroupInvocationID), a, valNormal, flux);
            [[unroll]] for (uint lane = 0; lane < kSubgroupSize; ++lane)
                accumulate(e, x, n, subgroupShuffle(a, lane), subgroupShuffle(valNormal, lane),
                           subgroupShuffle(flux, lane));
        }
    } else {
        for (uint i = push.first; i < push.last; ++i) {
            vec4 a;
            vec3 valNormal, flux;
            loadVal(int(i), a, valNormal, flux);
            accumulate(e, x, n, a, valNormal, flux);
        }
    }
    [[unroll]] for (int p = 0; p < kPixels; ++p) {
        ivec2 pixel = pixelOf(p);
        if (any(greaterThanEqual(pixel, ivec2(size)))) continue;
        vec3 sum = surface[p] ? e[p] : vec3(0.0);
        if (!kFirst) sum += imageLoad(irradiance, pixel).rgb;
        imageStore(irradiance, pixel, vec4(sum, 1.0));
    }
}
