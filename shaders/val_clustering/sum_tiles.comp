#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Segmented update, first half: for each tile, sums over the texels of each of its candidates, in texel order. A lane
// owns a candidate, so no atomics: the same texels always give the same bits. Positions are summed relative to the
// seed, which keeps second moments exact far from the origin. The farthest texels in eight directions of the seed's
// plane are noted too: the corners of the cluster's convex hull.
#include "common/lane_loop.glsl"
#include "common/sampling.h"
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
    vec3 areaOffset;     // area * offset
    float before;        // most along the seed's normal
    float most[kExtremes];
    uint farthest[kExtremes];  // texel in the tile
};

// What a candidate's texels are measured along: the seed's place and plane.
struct Frame {
    vec3 origin, t, b, n;
};

void keepFarther(inout Sums sums, int direction, float reach, uint texel) {
    bool farther = reach > sums.most[direction];
    sums.most[direction] = farther ? reach : sums.most[direction];
    sums.farthest[direction] = farther ? texel : sums.farthest[direction];
}

void measureExtent(inout Sums sums, bool mine, Frame f, vec3 offset, uint texel) {
    const float kNever = -3.0e38;
    float u = dot(offset, f.t), v = dot(offset, f.b);
    sums.before = max(sums.before, mine ? dot(offset, f.n) : kNever);
    float reach[4] = float[](u, u + v, v, v - u);
    [[unroll]] for (int i = 0; i < 4; ++i) {
        keepFarther(sums, i, mine ? reach[i] : kNever, texel);
        keepFarther(sums, i + 4, mine ? -reach[i] : kNever, texel);
    }
}

void addTexel(inout Sums sums, uint slot, uint texelSlot, Frame frame, vec4 a, vec4 b, vec3 flux, uint texel) {
    float mine = slot == texelSlot ? 1.0 : 0.0;
    float w = b.w * mine;
    vec3 offset = a.xyz - frame.origin;
    vec3 weighted = offset * w;
    sums.fluxArea += vec4(flux, a.w) * mine;
    sums.offsetWeight += vec4(weighted, w);
    sums.normalCount += vec4(b.xyz * w, mine);
    sums.momentDiagonal += weighted * offset;
    sums.momentMixed += weighted.xxy * offset.yzz;
    sums.areaOffset += offset * (a.w * mine);
    measureExtent(sums, slot == texelSlot, frame, offset, texel);
}

void sumCandidate(uint tile, uint slot, uint count) {
    uint cluster = texelFetch(candidates, int(tile * kMaxCandidates + min(slot, count - 1))).x;
    Frame frame;
    frame.origin = texelFetch(seeds, int(cluster) * 3).xyz;
    frame.n = texelFetch(seeds, int(cluster) * 3 + 1).xyz;
    orthonormalBasis(frame.n, frame.t, frame.b);
    Sums sums;
    sums.fluxArea = sums.offsetWeight = sums.normalCount = vec4(0.0);
    sums.momentDiagonal = sums.momentMixed = sums.areaOffset = vec3(0.0);
    sums.before = -3.0e38;
    for (int i = 0; i < int(kExtremes); ++i) {
        sums.most[i] = -3.0e38;
        sums.farthest[i] = 0;
    }
    int first = int(rsmTexelIndex(tile, 0));
    for (uint base = 0; base < kRsmTileSize * kRsmTileSize; base += kSubgroupSize) {
        int mine = first + int(base + gl_SubgroupInvocationID);
        uint texelSlot = texelFetch(slotOfTexel, mine).x;
        vec4 a = texelFetch(texels, mine * 3);
        vec4 b = texelFetch(texels, mine * 3 + 1);
        vec3 flux = texelFetch(texels, mine * 3 + 2).xyz;
        [[unroll]] for (uint lane = 0; lane < kSubgroupSize; ++lane)
            addTexel(sums, slot, subgroupShuffle(texelSlot, lane), frame, subgroupShuffle(a, lane),
                     subgroupShuffle(b, lane), subgroupShuffle(flux, lane), base + lane);
    }
    if (slot >= count) return;
    uint out0 = (tile * kMaxCandidates + slot) * kPartialVec4s;
    partials.items[out0] = sums.fluxArea;
    partials.items[out0 + 1] = sums.offsetWeight;
    partials.items[out0 + 2] = sums.normalCount;
    partials.items[out0 + 3] = vec4(sums.momentDiagonal, sums.before);
    partials.items[out0 + 4] = vec4(sums.momentMixed, 0.0);
    partials.items[out0 + 5] = vec4(sums.areaOffset, 0.0);
    for (int i = 0; i < 2; ++i) {
        partials.items[out0 + 6 + i] =
            vec4(sums.most[4 * i], sums.most[4 * i + 1], sums.most[4 * i + 2], sums.most[4 * i + 3]);
        partials.items[out0 + 8 + i] = vec4(sums.farthest[4 * i], sums.farthest[4 * i + 1],
                                            sums.farthest[4 * i + 2], sums.farthest[4 * i + 3]);
    }
}

void main() {
    uint tile = gl_WorkGroupID.x;
    uint count = candidateCounts.items[tile];
    uint stride = gl_NumWorkGroups.y * kSubgroupSize;
    for (uint base = gl_WorkGroupID.y * kSubgroupSize; base < count; base += stride)
        sumCandidate(tile, base + gl_SubgroupInvocationID, count);
}
