#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Each lit texel to the nearest of its tile's candidates by RSMC's metric (eq. 1); the lower index wins a tie. All
// texels of a tile meet the same candidates, so lanes load different ones and hand them round.
#include "common/clustering_metric.h"
#include "common/lane_loop.glsl"
#include "common/texels.glsl"
#include "rsm/rsm.glsl"
#include "val_clustering/val_clustering_io.h"

const uint kPerLane = 4;  // texels: what lanes hand round serves them all

layout(local_size_x = 64) in;  // one tile
layout(push_constant, scalar) uniform Push { ClusterSettings settings; } push;

layout(set = 0, binding = 0) VEC4_TEXELS(texels);
layout(set = 0, binding = 1) VEC4_TEXELS(seeds);
layout(set = 0, binding = 2) UINT_TEXELS(candidates);
layout(set = 0, binding = 3, scalar) readonly buffer CandidateCounts { uint items[]; } candidateCounts;
layout(set = 0, binding = 4, scalar) writeonly buffer SlotOfTexel { uint items[]; } slotOfTexel;

struct Texel {
    RsmSurface s;
    vec3 chroma;
    float metric;  // to the nearest so far
    uint slot;
};

struct Seed {
    vec3 position, normal, chroma;
};

Seed seedAt(uint candidate) {
    int at = int(fetchTexel(candidates, int(candidate)).x) * 3;
    return Seed(fetchTexel(seeds, at).xyz, fetchTexel(seeds, at + 1).xyz, fetchTexel(seeds, at + 2).xyz);
}

void consider(inout Texel texel[kPerLane], Seed seed, uint slot, bool real) {
    [[unroll]] for (uint i = 0; i < kPerLane; ++i) {
        float metric = clusterMetric(texel[i].s.position, texel[i].s.normal, texel[i].chroma, seed.position, seed.normal,
                                     seed.chroma, push.settings.metricWeights);
        bool nearer = real && metric < texel[i].metric;
        texel[i].metric = nearer ? metric : texel[i].metric;
        texel[i].slot = nearer ? slot : texel[i].slot;
    }
}

Seed fromLane(Seed seed, uint lane) {
    return Seed(subgroupShuffle(seed.position, lane), subgroupShuffle(seed.normal, lane),
                subgroupShuffle(seed.chroma, lane));
}

void main() {
    uint tile = gl_WorkGroupID.x, count = candidateCounts.items[tile], first = tile * kMaxCandidates;
    uint index[kPerLane];
    Texel texel[kPerLane];
    [[unroll]] for (uint i = 0; i < kPerLane; ++i) {
        index[i] = rsmTexelIndex(tile, i * gl_WorkGroupSize.x + gl_LocalInvocationID.x);
        RsmSurface s = AG_RSM_FETCH(texels, index[i]);
        texel[i] = Texel(s, s.flux * inversesqrt(max(dot(s.flux, s.flux), 1e-38)), 3.0e38, kNoCluster);
    }
    if (kLaneParallel) {
        for (uint base = 0; base < count; base += kSubgroupSize) {
            Seed mine = seedAt(first + min(base + gl_SubgroupInvocationID, count - 1));
            [[unroll]] for (uint lane = 0; lane < kSubgroupSize; ++lane)
                consider(texel, fromLane(mine, lane), base + lane, base + lane < count);
        }
    } else {
        for (uint slot = 0; slot < count; ++slot) consider(texel, seedAt(first + slot), slot, true);
    }
    [[unroll]] for (uint i = 0; i < kPerLane; ++i)
        slotOfTexel.items[index[i]] = texel[i].s.weight > 0.0 ? texel[i].slot : kNoCluster;
}
