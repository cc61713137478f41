#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Segmented update, first half: for each tile, sums over the texels of each of its candidates, in texel order. A lane
// owns a candidate, so no atomics: the same texels always give the same bits. Positions are summed relative to the
// seed, which keeps second moments exact far from the origin.
#include "common/lane_loop.glsl"
#include "rsm/rsm.glsl"
#include "val_clustering/val_clustering_io.h"

layout(local_size_x_id = 100) in;  // one subgroup; the groups along y share a tile's candidates

layout(set = 0, binding = 0) uniform samplerBuffer texels;
layout(set = 0, binding = 1) uniform samplerBuffer seeds;
layout(set = 0, binding = 2) uniform usamplerBuffer candidates;
layout(set = 0, binding = 3) uniform usamplerBuffer slotOfTexel;
layout(set = 0, binding = 4, scalar) readonly buffer CandidateCounts { uint items[]; } candidateCounts;
layout(set = 0, binding = 5, scalar) writeonly buffer Partials { vec4 items[]; } partials;

struct Sums {
    vec4 fluxArea;       // flux, area
    vec4 offsetWeight;   // w * (x - seed), w
    vec4 normalCount;    // w * n, texels
    vec3 momentDiagonal; // w * offset²
    vec3 momentMixed;    // w * offset products xy, xz, yz
};

void addTexel(inout Sums sums, uint slot, uint texelSlot, vec3 seed, vec4 a, vec4 b, vec3 flux) {
    float mine = slot == texelSlot ? 1.0 : 0.0;
    float w = b.w * mine;
    vec3 offset = a.xyz - seed;
    vec3 weighted = offset * w;
    sums.fluxArea += vec4(flux, a.w) * mine;
    sums.offsetWeight += vec4(weighted, w);
    sums.normalCount += vec4(b.xyz * w, mine);
    sums.momentDiagonal += weighted * offset;
    sums.momentMixed += weighted.xxy * offset.yzz;
}

void sumCandidate(uint tile, uint slot, uint count) {
    uint cluster = texelFetch(candidates, int(tile * kMaxCandidates + min(slot, count - 1))).x;
    vec3 seed = texelFetch(seeds, int(cluster) * 3).xyz;
    Sums sums = Sums(vec4(0.0), vec4(0.0), vec4(0.0), vec3(0.0), vec3(0.0));
    int first = int(rsmTexelIndex(tile, 0));
    for (uint base = 0; base < kRsmTileSize * kRsmTileSize; base += kSubgroupSize) {
        int mine = first + int(base + gl_SubgroupInvocationID);
        uint texelSlot = texelFetch(slotOfTexel, mine).x;
        vec4 a = texelFetch(texels, mine * 3);
        vec4 b = texelFetch(texels, mine * 3 + 1);
        vec3 flux = texelFetch(texels, mine * 3 + 2).xyz;
        [[unroll]] for (uint lane = 0; lane < kSubgroupSize; ++lane)
            addTexel(sums, slot, subgroupShuffle(texelSlot, lane), seed, subgroupShuffle(a, lane),
                     subgroupShuffle(b, lane), subgroupShuffle(flux, lane));
    }
    if (slot >= count) return;
    uint out0 = (tile * kMaxCandidates + slot) * kPartialVec4s;
    partials.items[out0] = sums.fluxArea;
    partials.items[out0 + 1] = sums.offsetWeight;
    partials.items[out0 + 2] = sums.normalCount;
    partials.items[out0 + 3] = vec4(sums.momentDiagonal, 0.0);
    partials.items[out0 + 4] = vec4(sums.momentMixed, 0.0);
}

void main() {
    uint tile = gl_WorkGroupID.x;
    uint count = candidateCounts.items[tile];
    uint stride = gl_NumWorkGroups.y * kSubgroupSize;
    for (uint base = gl_WorkGroupID.y * kSubgroupSize; base < count; base += stride)
        sumCandidate(tile, base + gl_SubgroupInvocationID, count);
}
