#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Irradiance straight from a tile's punctual lights at every pixel: what arrives without shadows, worked out here,
// times the share that does arrive about here, from the up to four neighbours for which shadows were found. Four pixels
// an invocation share the loads.
#include "common/lane_loop.glsl"
#include "common/texels.glsl"
#include "gbuffer/gbuffer.glsl"

layout(local_size_x = 64) in;  // one tile

layout(constant_id = 0) const bool kFirst = true;  // starts from zero instead of adding
layout(set = 0, binding = 0) uniform sampler2D normalMap;
layout(set = 0, binding = 1) uniform sampler2D depthMap;
layout(set = 0, binding = 3) VEC4_TEXELS(lights);
layout(set = 0, binding = 7) UINT_TEXELS(lists);
#include "direct_lighting/punctual_light.glsl"
layout(set = 0, binding = 2, scalar) uniform Camera { CameraConstants camera; } camera;
#include "direct_lighting/receiver.glsl"
layout(set = 0, binding = 4) uniform sampler2D shadowed;
layout(set = 0, binding = 5) uniform sampler2D unshadowed;
layout(set = 0, binding = 8, scalar) readonly buffer Counts { uint items[]; } counts;
layout(set = 0, binding = 9, rgba16f) uniform image2D irradiance;
#include "direct_lighting/highlight.glsl"

PunctualLight lightOfLane(PunctualLight mine, uint lane) {
    PunctualLight light;
    light.position = subgroupShuffle(mine.position, lane);
    light.inverseRange2 = subgroupShuffle(mine.inverseRange2, lane);
    light.intensity = subgroupShuffle(mine.intensity, lane);
    light.axis = subgroupShuffle(mine.axis, lane);
    light.coneOffset = subgroupShuffle(mine.coneOffset, lane);
    return light;
}

void meet(PunctualLight light, Receiver r[kPixels], Lobe lobe[kPixels], inout vec3 e[kPixels], inout vec3 shine[kPixels]) {
    [[unroll]] for (int p = 0; p < kPixels; ++p) {
        float distance2;
        vec3 from = irradianceFrom(light, r[p].position, r[p].normal, distance2);
        e[p] += from;
        if (kGlossy) shine[p] += highlightOf(lobe[p], r[p].normal, normalize(light.position - r[p].position), from);
    }
}

// 1 on the same plane, facing the same way. `pixel`: m at the receiver. Never quite 0, so that something is taken.
float likeness(Receiver a, Receiver b, float pixel) {
    float apart = dot(a.normal, b.position - a.position) / pixel, facing = max(dot(a.normal, b.normal), 0.0);
    return b.depth > 0.0 ? max(facing * facing / (1.0 + apart * apart * apart * apart), 1e-4) : 0.0;
}

void main() {
    uvec2 size = camera.camera.size, tiles = (size + kPunctualTileSize - 1) / kPunctualTileSize;
    uint tile = gl_WorkGroupID.x, block = gl_LocalInvocationID.x;
    uvec2 origin = uvec2(tile % tiles.x, tile / tiles.x) * kPunctualTileSize + 2 * uvec2(block % 8, block / 8);
    Receiver r[kPixels];
    vec3 e[kPixels], shine[kPixels];
    Lobe lobe[kPixels];
    [[unroll]] for (int p = 0; p < kPixels; ++p) {
        uvec2 at = origin + uvec2(p & 1, p >> 1);
        r[p] = receiverAt(at);
        e[p] = shine[p] = vec3(0.0);
        lobe[p] = lobeAt(ivec2(min(at, size - 1)), r[p].position, r[p].roughness);
    }
    uint first = tile * kMaxPunctualLightsPerTile, end = first + counts.items[tile];
    if (kLaneParallel) {
        for (uint base = first; base < end; base += kSubgroupSize) {
            uint entry = base + gl_SubgroupInvocationID;
            PunctualLight mine = punctualLightAt(fetchTexel(lists, int(min(entry, end - 1))).x);
            if (entry >= end) mine.intensity = vec3(0.0);
            [[unroll]] for (uint lane = 0; lane < kSubgroupSize; ++lane) {
                PunctualLight light = lightOfLane(mine, lane);
                meet(light, r, lobe, e, shine);
            }
        }
    } else {
        for (uint entry = first; entry < end; ++entry) {
            PunctualLight light = punctualLightAt(fetchTexel(lists, int(entry)).x);
            meet(light, r, lobe, e, shine);
        }
    }
    Receiver near[kPixels];  // those for which shadows were found
    vec3 some[kPixels], all[kPixels];
    [[unroll]] for (int q = 0; q < kPixels; ++q) {
        uvec2 at = min(origin / 2 + uvec2(q & 1, q >> 1), (size - 1) / 2);
        near[q] = receiverAt(2 * at);
        some[q] = texelFetch(shadowed, ivec2(at), 0).rgb;
        all[q] = texelFetch(unshadowed, ivec2(at), 0).rgb;
    }
    mat4 clip = camera.camera.clipFromWorld;  // its second row is the image's up, as long as a half angle's cotangent
    float pixelAtOne = 2.0 / (float(size.y) * length(vec3(clip[0].y, clip[1].y, clip[2].y)));
    [[unroll]] for (int p = 0; p < kPixels; ++p) {
        uvec2 pixel = origin + uvec2(p & 1, p >> 1);
        float metres = pixelAtOne * camera.camera.near / max(r[p].depth, 1e-9);
        vec3 arrived = vec3(0.0), sent = vec3(0.0);
        [[unroll]] for (int q = 0; q < kPixels; ++q) {
            bool between = (q & ~p) == 0;  // pixel 0 takes its own, 1 also the right one's, 2 the lower one's, 3 all
            float w = between ? likeness(r[p], near[q], metres) : 0.0;
            arrived += w * some[q];
            sent += w * all[q];
        }
        vec3 share = mix(vec3(1.0), arrived / max(sent, vec3(1e-20)), greaterThan(sent, vec3(1e-20)));
        vec3 result = r[p].depth > 0.0 ? e[p] * share : vec3(0.0);
        if (any(greaterThanEqual(pixel, size))) continue;
        addHighlight(ivec2(pixel), r[p].depth > 0.0 ? shine[p] * share : vec3(0.0), kFirst);
        if (!kFirst) result += imageLoad(irradiance, ivec2(pixel)).rgb;
        imageStore(irradiance, ivec2(pixel), vec4(min(result, vec3(kMostHalf)), 1.0));
    }
}
