#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Segmented update, first half: for each tile, sums over the texels of each of its candidates that has any. They lie
// one after another, in any order. A lane owns texels, so no atomics: the same texels always give the same bits. Positions
// are summed relative to the seed, which keeps second moments exact far from the origin. The farthest texels in eight
// directions of the seed's plane are noted too: the corners of the cluster's convex hull.
#include "common/lanes.glsl"
#include "common/sampling.h"
#include "common/texels.glsl"
#include "rsm/rsm.glsl"
#include "val_clustering/val_clustering_io.h"

layout(push_constant, scalar) uniform Push { uint clusterCount, mostPartials; } push;

layout(set = 0, binding = 0) VEC4_TEXELS(texels);
layout(set = 0, binding = 1) VEC4_TEXELS(seeds);
layout(set = 0, binding = 2) UINT_TEXELS(candidates);
layout(set = 0, binding = 3) UINT_TEXELS(slotOfTexel);
layout(set = 0, binding = 4, scalar) readonly buffer CandidateCounts { uint items[]; } candidateCounts;
layout(set = 0, binding = 5, scalar) writeonly buffer Partials { vec4 items[]; } partials;
layout(set = 0, binding = 6, scalar) writeonly buffer PartialOf { uint items[]; } partialOf;
layout(set = 0, binding = 7, scalar) buffer PartialCount { uint count; } partialCount;

const uint kTileTexels = kRsmTileSize * kRsmTileSize;
const float kNever = -3.0e38;
const uint kNoTexel = 0x7f7fffffu;  // as far as can be

struct Sums {
    vec4 fluxArea;       // flux, area
    vec4 offsetWeight;   // w * (x - seed), w
    vec4 normalCount;    // w * n, texels
    vec3 momentDiagonal; // w * offset²
    vec3 momentMixed;    // w * offset products xy, xz, yz
    vec3 areaOffset;     // area * offset
    float before;        // most along the seed's normal
    uint nearest;        // to the seed: squared distance, the last eight bits the texel in the tile
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
    float u = dot(offset, f.t), v = dot(offset, f.b);
    sums.before = max(sums.before, mine ? dot(offset, f.n) : kNever);
    float reach[4] = float[](u, u + v, v, v - u);
    [[unroll]] for (int i = 0; i < 4; ++i) {
        keepFarther(sums, i, mine ? reach[i] : kNever, texel);
        keepFarther(sums, i + 4, mine ? -reach[i] : kNever, texel);
    }
}

void addTexel(inout Sums sums, bool isMember, Frame frame, vec4 a, vec4 b, vec3 flux, uint texel) {
    float mine = isMember ? 1.0 : 0.0;
    float w = b.w * mine;
    vec3 offset = a.xyz - frame.origin;
    vec3 weighted = offset * w;
    sums.fluxArea += vec4(flux, a.w) * mine;
    sums.offsetWeight += vec4(weighted, w);
    sums.normalCount += vec4(b.xyz * w, mine);
    sums.momentDiagonal += weighted * offset;
    sums.momentMixed += weighted.xxy * offset.yzz;
    sums.areaOffset += offset * (a.w * mine);
    uint near = floatBitsToUint(dot(offset, offset)) & ~(kTileTexels - 1) | texel;
    sums.nearest = min(sums.nearest, isMember ? near : kNoTexel);
    measureExtent(sums, isMember, frame, offset, texel);
}

Sums noTexels() {
    Sums sums;
    sums.fluxArea = sums.offsetWeight = sums.normalCount = vec4(0.0);
    sums.momentDiagonal = sums.momentMixed = sums.areaOffset = vec3(0.0);
    sums.before = kNever;
    sums.nearest = kNoTexel;
    for (int i = 0; i < int(kExtremes); ++i) {
        sums.most[i] = kNever;
        sums.farthest[i] = 0;
    }
    return sums;
}

// Over all lanes; of equally far texels the one of the lowest index.
Sums addLanes(Sums s) {
    s.fluxArea = laneAdd(s.fluxArea);
    s.offsetWeight = laneAdd(s.offsetWeight);
    s.normalCount = laneAdd(s.normalCount);
    s.momentDiagonal = laneAdd(s.momentDiagonal);
    s.momentMixed = laneAdd(s.momentMixed);
    s.areaOffset = laneAdd(s.areaOffset);
    s.before = laneMax(s.before);
    s.nearest = laneMin(s.nearest);
    [[unroll]] for (int i = 0; i < int(kExtremes); ++i) {
        float most = laneMax(s.most[i]);
        s.farthest[i] = laneMin(s.most[i] == most ? s.farthest[i] : kTileTexels - 1);
        s.most[i] = most;
    }
    return s;
}

void store(uint at, Sums s) {
    partials.items[at] = s.fluxArea;
    partials.items[at + 1] = s.offsetWeight;
    partials.items[at + 2] = s.normalCount;
    partials.items[at + 3] = vec4(s.momentDiagonal, s.before);
    partials.items[at + 4] = vec4(s.momentMixed, 0.0);
    partials.items[at + 5] = vec4(s.areaOffset, uintBitsToFloat(s.nearest));
    [[unroll]] for (int i = 0; i < 2; ++i) {
        partials.items[at + 6 + i] = vec4(s.most[4 * i], s.most[4 * i + 1], s.most[4 * i + 2], s.most[4 * i + 3]);
        partials.items[at + 8 + i] =
            vec4(s.farthest[4 * i], s.farthest[4 * i + 1], s.farthest[4 * i + 2], s.farthest[4 * i + 3]);
    }
}

Sums sumCandidate(uint tile, uint slot, uint cluster) {
    Frame frame;
    frame.origin = fetchTexel(seeds, int(cluster) * 3).xyz;
    frame.n = fetchTexel(seeds, int(cluster) * 3 + 1).xyz;
    orthonormalBasis(frame.n, frame.t, frame.b);
    Sums sums = noTexels();
    int first = int(rsmTexelIndex(tile, 0));
    for (uint base = 0; base < kTileTexels; base += kLanes) {
        uint texel = base + laneIndex();
        int at = first + int(texel);
        addTexel(sums, fetchTexel(slotOfTexel, at).x == slot, frame, fetchTexel(texels, at * 3),
                 fetchTexel(texels, at * 3 + 1), fetchTexel(texels, at * 3 + 2).xyz, texel);
    }
    return addLanes(sums);
}

// Of 32 candidates from the first on, a bit each for those that have texels in the tile.
uint membersFrom(uint tile, uint first) {
    uint found = 0;
    for (uint base = 0; base < kTileTexels; base += kLanes) {
        uint slot = fetchTexel(slotOfTexel, int(rsmTexelIndex(tile, base + laneIndex()))).x - first;
        found |= slot < 32 ? 1u << (slot & 31u) : 0u;  // unlit: beyond
    }
    return laneOr(found);
}

void main() {
    uint tile = gl_WorkGroupID.x, count = candidateCounts.items[tile];
    for (uint first = 0; first < count; first += 32) {
        uint members = membersFrom(tile, first), at = 0;
        if (laneIndex() == 0) at = atomicAdd(partialCount.count, bitCount(members));
        at = laneBroadcastFirst(at);
        for (uint left = members; left != 0; left &= left - 1, ++at) {
            uint slot = first + uint(findLSB(left));
            uint cluster = fetchTexel(candidates, int(tile * kMaxCandidates + slot)).x;
            Sums sums = sumCandidate(tile, slot, cluster);
            if (laneIndex() == 0 && at < push.mostPartials) {
                store(at * kPartialVec4s, sums);
                partialOf.items[tile * push.clusterCount + cluster] = at;
            }
        }
    }
}
