#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Where the texels of each cluster go in one list of all clusters' texels: cluster by cluster, tile by tile. One group of
// lanes a cluster.
#include "common/lanes.glsl"
#include "common/texels.glsl"
#include "val_clustering/val_clustering_io.h"

layout(push_constant) uniform Push { uint clusterCount, tileCount; } push;

layout(set = 0, binding = 0, scalar) readonly buffer Clusters { Cluster items[]; } clusters;
layout(set = 0, binding = 1) UINT_TEXELS(partialOf);
layout(set = 0, binding = 2) VEC4_TEXELS(partials);
layout(set = 0, binding = 3, scalar) writeonly buffer MemberRanges { uint items[]; } memberRanges;  // first, count
layout(set = 0, binding = 4, scalar) writeonly buffer TileMembers { uint items[]; } tileMembers;    // first, of each partial

void main() {
    uint cluster = gl_WorkGroupID.x;
    float before = 0.0;
    for (uint base = 0; base < cluster; base += kLanes) {
        uint c = base + laneIndex();
        before += c < cluster ? clusters.items[c].texelCount : 0.0;
    }
    uint first = uint(laneAdd(before)), next = first;
    for (uint base = 0; base < push.tileCount; base += kLanes) {
        uint tile = base + laneIndex();
        uint partial = tile < push.tileCount ? fetchTexel(partialOf, int(tile * push.clusterCount + cluster)).x : kNoCluster;
        bool any = partial != kNoCluster;
        float here = any ? fetchTexel(partials, int(partial * kPartialVec4s + 2)).w : 0.0;
        float upTo = laneInclusiveAdd(here);  // whole numbers below 2^24: exact
        if (any) tileMembers.items[partial] = next + uint(upTo - here);
        next += uint(laneAdd(here));
    }
    if (laneIndex() == 0) {
        memberRanges.items[cluster * 2] = first;
        memberRanges.items[cluster * 2 + 1] = next - first;
    }
}
