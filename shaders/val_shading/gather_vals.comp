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
const uint kShapeRectangle = 3;   // a rectangle's vector irradiance by its edges
layout(constant_id = 0) const uint kShape = kShapeRectangle;

layout(constant_id = 1) const bool kFirst = true;  // starts from zero instead of adding
layout(push_constant, scalar) uniform Push { uint first, last; } push;  // lights, whole subgroups of them

layout(set = 0, binding = 0) uniform sampler2D normalMap;
layout(set = 0, binding = 1) uniform sampler2D depthMap;
layout(set = 0, binding = 2, scalar) readonly buffer Camera { CameraConstants camera; } camera;
layout(set = 0, binding = 3) uniform samplerBuffer vals;
layout(set = 0, binding = 5) uniform samplerBuffer shapes;
layout(set = 0, binding = 4, rgba16f) uniform image2D irradiance;

const int kPixels = 4;

struct AreaLight {
    vec4 place;   // centre; area, or radius² of a vector disk
    vec3 normal;
    vec3 power;   // flux, or radiosity where the shape's term is a form factor
    vec3 halfU, halfV;
};

AreaLight loadLight(int index) {
    AreaLight l;
    l.place = texelFetch(vals, index * 3);
    l.normal = texelFetch(vals, index * 3 + 1).xyz;
    l.power = texelFetch(vals, index * 3 + 2).xyz;
    l.halfU = l.halfV = vec3(0.0);
    if (kShape == kShapeVectorDisk) {
        l.power /= l.place.w;
        l.place.w *= kInvPi;
    }
    if (kShape == kShapeRectangle) {
        vec4 u = texelFetch(shapes, index * 2);
        l.halfU = u.xyz;
        l.power *= u.w;
        l.halfV = texelFetch(shapes, index * 2 + 1).xyz;
    }
    return l;
}

// The light another lane holds.
AreaLight lightOfLane(AreaLight mine, uint lane) {
    AreaLight l;
    l.place = subgroupShuffle(mine.place, lane);
    l.normal = subgroupShuffle(mine.normal, lane);
    l.power = subgroupShuffle(mine.power, lane);
    l.halfU = kShape == kShapeRectangle ? subgroupShuffle(mine.halfU, lane) : vec3(0.0);
    l.halfV = kShape == kShapeRectangle ? subgroupShuffle(mine.halfV, lane) : vec3(0.0);
    return l;
}

float shapeTerm(vec3 x, vec3 n, AreaLight l) {
    if (kShape == kShapePoint) return vplTerm(x, n, l.place.xyz, l.normal);
    if (kShape == kShapeDisk) return diskPublishedTerm(x, n, l.place.xyz, l.normal, l.place.w);
    if (kShape == kShapeVectorDisk) return diskVectorFactor(x, n, l.place.xyz, l.normal, l.place.w);
    return rectangleVectorFactor(x, n, l.place.xyz, l.normal, l.halfU, l.halfV);
}

void accumulate(inout vec3 e[kPixels], vec3 x[kPixels], vec3 n[kPixels], AreaLight l) {
    [[unroll]] for (int p = 0; p < kPixels; ++p) e[p] += l.power * shapeTerm(x[p], n[p], l);
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
            AreaLight mine = loadLight(int(base + gl_SubgroupInvocationID));
            [[unroll]] for (uint lane = 0; lane < kSubgroupSize; ++lane) accumulate(e, x, n, lightOfLane(mine, lane));
        }
    } else {
        for (uint i = push.first; i < push.last; ++i) accumulate(e, x, n, loadLight(int(i)));
    }
    [[unroll]] for (int p = 0; p < kPixels; ++p) {
        ivec2 pixel = pixelOf(p);
        if (any(greaterThanEqual(pixel, ivec2(size)))) continue;
        vec3 sum = surface[p] ? e[p] : vec3(0.0);
        if (!kFirst) sum += imageLoad(irradiance, pixel).rgb;
        imageStore(irradiance, pixel, vec4(sum, 1.0));
    }
}
