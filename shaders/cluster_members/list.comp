#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Each lit texel into its cluster's list, in the texels' order. One group of lanes a tile of the maps.
#include "common/lanes.glsl"
#include "common/texels.glsl"
#include "rsm/rsm.glsl"
#include "val_clustering/val_clustering_io.h"

layout(push_constant) uniform Push { uint clusterCount, tileCount; } push;

layout(set = 0, binding = 0) UINT_TEXELS(slotOfTexel);
layout(set = 0, binding = 1) UINT_TEXELS(candidates);
layout(set = 0, binding = 2) UINT_TEXELS(partialOf);
layout(set = 0, binding = 3) UINT_TEXELS(tileMembers);
layout(set = 0, binding = 4, scalar) writeonly buffer Members { uint items[]; } members;

shared uint placed[kMaxCandidates];  // of each candidate's texels

void main() {
    uint tile = gl_WorkGroupID.x;
    for (uint i = laneIndex(); i < kMaxCandidates; i += kLanes) placed[i] = 0;
    laneBarrier();
    const uint kTileTexels = kRsmTileSize * kRsmTileSize;
    for (uint base = 0; base < kTileTexels; base += kLanes) {
        uint texel = rsmTexelIndex(tile, base + laneIndex());
        uint slot = fetchTexel(slotOfTexel, int(texel)).x;
        bool lit = slot != kNoCluster;
        uint before = 0, alike = 0;
        for (uint lane = 0; lane < kLanes; ++lane) {
            bool same = laneShuffle(slot, lane) == slot;
            before += same && lane < laneIndex() ? 1 : 0;
            alike += same ? 1 : 0;
        }
        uint rank = lit ? placed[slot] + before : 0;
        laneBarrier();
        if (lit && before == 0) placed[slot] += alike;
        laneBarrier();
        if (!lit) continue;
        uint cluster = fetchTexel(candidates, int(tile * kMaxCandidates + slot)).x;
        uint partial = fetchTexel(partialOf, int(tile * push.clusterCount + cluster)).x;
        members.items[fetchTexel(tileMembers, int(partial)).x + rank] = texel;
    }
}
