#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Each lit texel to the nearest of its tile's candidates by RSMC's metric (eq. 1); the lower index wins a tie. All
// texels of a tile meet the same candidates, so lanes load different ones and hand them round.
#include "common/clustering_metric.h"
#include "common/lane_loop.glsl"
#include "rsm/rsm.glsl"
#include "val_clustering/val_clustering_io.h"

layout(local_size_x = 256) in;  // one tile
layout(push_constant, scalar) uniform Push { ClusterSettings settings; } push;

layout(set = 0, binding = 0) uniform samplerBuffer texels;
layout(set = 0, binding = 1) uniform samplerBuffer seeds;
layout(set = 0, binding = 2) uniform usamplerBuffer candidates;
layout(set = 0, binding = 3, scalar) readonly buffer CandidateCounts { uint items[]; } candidateCounts;
layout(set = 0, binding = 4, scalar) writeonly buffer SlotOfTexel { uint items[]; } slotOfTexel;

struct Nearest {
    float metric;
    uint slot;
};

void consider(inout Nearest best, RsmSurface s, vec3 chroma, vec3 position, vec3 normal, vec3 seedChroma, uint slot,
              uint count) {
    float metric = clusterMetric(s.position, s.normal, chroma, position, normal, seedChroma,
                                 push.settings.metricWeights);
    bool nearer = slot < count && metric < best.metric;
    best.metric = nearer ? metric : best.metric;
    best.slot = nearer ? slot : best.slot;
}

void main() {
    uint tile = gl_WorkGroupID.x;
    uint index = rsmTexelIndex(tile, gl_LocalInvocationID.x);
    RsmSurface s = AG_RSM_FETCH(texels, index);
    vec3 chroma = s.flux * inversesqrt(max(dot(s.flux, s.flux), 1e-38));
    uint count = candidateCounts.items[tile];
    uint first = tile * kMaxCandidates;

    Nearest best = Nearest(3.0e38, kNoCluster);
    if (kLaneParallel) {
        for (uint base = 0; base < count; base += kSubgroupSize) {
            uint mySlot = min(base + gl_SubgroupInvocationID, count - 1);
            int seed = int(texelFetch(candidates, int(first + mySlot)).x) * 3;
            vec3 position = texelFetch(seeds, seed).xyz;
            vec3 normal = texelFetch(seeds, seed + 1).xyz;
            vec3 seedChroma = texelFetch(seeds, seed + 2).xyz;
            [[unroll]] for (uint lane = 0; lane < kSubgroupSize; ++lane)
                consider(best, s, chroma, subgroupShuffle(position, lane), subgroupShuffle(normal, lane),
                         subgroupShuffle(seedChroma, lane), base + lane, count);
        }
    } else {
        for (uint slot = 0; slot < count; ++slot) {
            int seed = int(texelFetch(candidates, int(first + slot)).x) * 3;
            consider(best, s, chroma, texelFetch(seeds, seed).xyz, texelFetch(seeds, seed + 1).xyz,
                     texelFetch(seeds, seed + 2).xyz, slot, count);
        }
    }
    slotOfTexel.items[index] = s.weight > 0.0 ? best.slot : kNoCluster;
}
