// Irradiance straight from a tile's punctual lights. They come sorted by cluster, so that each cluster's visibility is
// found once a pixel for all of its lights. Four pixels an invocation share the loads. AG_QUADS: for one pixel in each
// 2 x 2, and beside it what arrived if nothing cast shadows. AG_TRACED: rays find the edges of shadows.
#include "common/texels.glsl"
#include "gbuffer/gbuffer.glsl"

layout(constant_id = 0) const bool kFirst = true;  // starts from zero instead of adding
layout(constant_id = 2) const float kShadowReach = 0.0;
layout(set = 0, binding = 0) uniform sampler2D normalMap;
layout(set = 0, binding = 1) uniform sampler2D depthMap;
layout(set = 0, binding = 3) VEC4_TEXELS(lights);
layout(set = 0, binding = 7) UINT_TEXELS(lists);
#include "direct_lighting/punctual_light.glsl"
layout(set = 0, binding = 2, scalar) uniform Camera { CameraConstants camera; } camera;
layout(set = 0, binding = 8, scalar) readonly buffer Counts { uint items[]; } counts;
#include "direct_lighting/receiver.glsl"
#ifdef AG_QUADS
const uint kStep = 2;
layout(local_size_x = 16) in;  // one tile
layout(set = 0, binding = 9, rgba16f) uniform writeonly image2D shadowed;
layout(set = 0, binding = 10, rgba16f) uniform writeonly image2D unshadowed;
#else
const uint kStep = 1;
layout(local_size_x = 64) in;
layout(set = 0, binding = 9, rgba16f) uniform image2D irradiance;
#include "direct_lighting/highlight.glsl"
#endif
#ifdef AG_SHADOW
layout(set = 0, binding = 4) VEC4_TEXELS(clusters);
layout(set = 0, binding = 6) uniform sampler2D shadowAtlas;
#include "direct_lighting/punctual_shadow.glsl"
#endif
#ifdef AG_TRACED
layout(push_constant, scalar) uniform Push { RayOffsets offsets; } push;
#include "direct_lighting/traced_shadow.glsl"
#endif

uint lightIndex(uint entry) { return fetchTexel(lists, int(entry)).x; }

// Of a cluster, for each pixel. A loop, so that what is long is there once.
vec4 clusterShares(uint cluster, Receiver r[kPixels]) {
    vec4 shares = vec4(1.0);
#ifdef AG_SHADOW
    bool casts = cluster != kNoLightCluster;
    int count = casts ? kPixels : 0;
    [[dont_unroll]] for (int p = 0; p < count; ++p) {
        vec3 position = r[0].position, normal = r[0].normal;
        [[unroll]] for (int q = 1; q < kPixels; ++q) {
            position = p == q ? r[q].position : position;
            normal = p == q ? r[q].normal : normal;
        }
        float share = clusterShare(casts ? cluster : 0u, position, normal);
        [[unroll]] for (int q = 0; q < kPixels; ++q) shares[q] = casts && p == q ? share : shares[q];
    }
#endif
    return shares;
}

#ifdef AG_TRACED
// A ray to the light where its cluster's map says neither 0 nor 1. `shares` by that map; `lit`: what it makes of the light.
vec4 tracedShares(PunctualLight light, Receiver r[kPixels], ivec2 origin, vec4 shares, vec4 lit) {
    int count = light.cluster != kNoLightCluster ? kPixels : 0;
    float near = light.cluster != kNoLightCluster ? fetchCluster(light.cluster).nearDistance : 0.0;
    [[dont_unroll]] for (int p = 0; p < count; ++p) {
        Receiver at = r[0];
        float share = shares[0];
        [[unroll]] for (int q = 1; q < kPixels; ++q) {
            at.position = p == q ? r[q].position : at.position;
            at.normal = p == q ? r[q].normal : at.normal;
            at.depth = p == q ? r[q].depth : at.depth;
            share = p == q ? shares[q] : share;
        }
        bool sure = share <= 0.0 || share >= 1.0 || at.depth <= 0.0 || dot(at.normal, light.position - at.position) <= 0.0;
        if (sure) continue;
        vec3 start = shadowRayStart(at.position, at.normal, origin + ivec2(p & 1, p >> 1), at.depth, push.offsets);
        vec3 toLight = light.position - start;
        bool blocked = isBlocked(start, toLight, max(1.0 - near / length(toLight), 0.0));
        [[unroll]] for (int q = 0; q < kPixels; ++q) lit[q] = p != q ? lit[q] : blocked ? 0.0 : 1.0;
    }
    return lit;
}
#endif

void main() {
    uvec2 size = camera.camera.size, tiles = (size + kPunctualTileSize - 1) / kPunctualTileSize;
    uint tile = gl_WorkGroupID.x, block = gl_LocalInvocationID.x;
    const uint kSide = kPunctualTileSize / kStep / 2;  // blocks of 2 x 2 along a tile
    uvec2 origin = uvec2(tile % tiles.x, tile / tiles.x) * (kPunctualTileSize / kStep) + 2 * uvec2(block % kSide, block / kSide);
    Receiver r[kPixels];
    vec3 e[kPixels], all[kPixels];
#ifndef AG_QUADS
    Lobe lobe[kPixels];
    vec3 shine[kPixels];
#endif
    [[unroll]] for (int p = 0; p < kPixels; ++p) {
        uvec2 at = (origin + uvec2(p & 1, p >> 1)) * kStep;
        r[p] = receiverAt(at);
        e[p] = all[p] = vec3(0.0);
#ifndef AG_QUADS
        lobe[p] = lobeAt(ivec2(min(at, size - 1)), r[p].position, r[p].roughness);
        shine[p] = vec3(0.0);
#endif
    }
    uint first = tile * kMaxPunctualLightsPerTile, end = first + counts.items[tile];
    for (uint i = first; i < end;) {
        uint cluster = punctualLightAt(lightIndex(i)).cluster;
        vec4 shares = clusterShares(cluster, r);
        for (; i < end; ++i) {
            PunctualLight light = punctualLightAt(lightIndex(i));
            if (light.cluster != cluster) break;
            vec3 from[kPixels];
            vec4 lit;
            [[unroll]] for (int p = 0; p < kPixels; ++p) {
                float distance2;
                from[p] = irradianceFrom(light, r[p].position, r[p].normal, distance2);
                lit[p] = 1.0 - (1.0 - shares[p]) * shadowWeight(light, distance2, kShadowReach);
            }
#ifdef AG_TRACED
            lit = tracedShares(light, r, ivec2(origin), shares, lit);
#endif
            [[unroll]] for (int p = 0; p < kPixels; ++p) {
                all[p] += from[p];
                vec3 arrives = from[p] * lit[p];
                e[p] += arrives;
#ifndef AG_QUADS
                if (kGlossy) shine[p] += highlightOf(lobe[p], r[p].normal, normalize(light.position - r[p].position), arrives);
#endif
            }
        }
    }
    [[unroll]] for (int p = 0; p < kPixels; ++p) {
        ivec2 at = ivec2(origin + uvec2(p & 1, p >> 1));
        if (any(greaterThanEqual(at * int(kStep), ivec2(size)))) continue;
        bool there = r[p].depth > 0.0;
#ifdef AG_QUADS
        imageStore(shadowed, at, vec4(there ? min(e[p], vec3(kMostHalf)) : vec3(0.0), 1.0));
        imageStore(unshadowed, at, vec4(there ? min(all[p], vec3(kMostHalf)) : vec3(0.0), 1.0));
#else
        addHighlight(at, there ? shine[p] : vec3(0.0), kFirst);
        vec3 sum = there ? e[p] : vec3(0.0);
        if (!kFirst) sum += imageLoad(irradiance, at).rgb;
        imageStore(irradiance, at, vec4(min(sum, vec3(kMostHalf)), 1.0));
#endif
    }
}
