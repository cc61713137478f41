#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_KHR_shader_subgroup_ballot : require
#extension GL_KHR_shader_subgroup_arithmetic : require
// For each tile, in ascending order, the clusters whose seeds lie within its map's candidate radius (RSMC's r = 2
// cells of a sqrt(k) x sqrt(k) grid, rounded to tiles). Where none does, the nearest ones: every lit texel finds a
// cluster. One subgroup a tile, so that the order is fixed.
#include "common/lane_loop.glsl"
#include "rsm/rsm_io.h"
#include "val_clustering/val_clustering_io.h"

layout(local_size_x_id = 100) in;
layout(push_constant, scalar) uniform Push { ClusterSettings settings; } push;

layout(set = 0, binding = 0) uniform samplerBuffer seeds;
layout(set = 0, binding = 1, scalar) uniform Maps { RsmMap items[kMaxRsmMaps]; } maps;
layout(set = 0, binding = 2, scalar) readonly buffer TileMaps { uint items[]; } tileMaps;
layout(set = 0, binding = 3, scalar) writeonly buffer Candidates { uint items[]; } candidates;
layout(set = 0, binding = 4, scalar) writeonly buffer CandidateCounts { uint items[]; } candidateCounts;
layout(set = 0, binding = 5, scalar) writeonly buffer SlotOfCluster { uint items[]; } slotOfCluster;

// Chebyshev distance in tiles; far beyond any map for dead seeds and other maps' clusters.
uint tileDistance(uint cluster, uvec2 tile, uint map) {
    const uint kFar = 1u << 20;
    uint seedTile = floatBitsToUint(texelFetch(seeds, int(cluster) * 3).w);
    uint seedMap = floatBitsToUint(texelFetch(seeds, int(cluster) * 3 + 1).w);
    uint tilesX = push.settings.atlasSize.x / kRsmTileSize;
    ivec2 d = abs(ivec2(seedTile % tilesX, seedTile / tilesX) - ivec2(tile));
    return seedTile == kNoCluster || seedMap != map ? kFar : uint(max(d.x, d.y));
}

void main() {
    uint tile = gl_WorkGroupID.x;
    uint tilesX = push.settings.atlasSize.x / kRsmTileSize;
    uvec2 place = uvec2(tile % tilesX, tile / tilesX);
    uint map = tileMaps.items[tile];
    uint count = push.settings.clusterCount;

    uint nearest = 1u << 20;
    for (uint base = 0; base < count; base += kSubgroupSize) {
        uint cluster = base + gl_SubgroupInvocationID;
        if (cluster < count) nearest = min(nearest, tileDistance(cluster, place, map));
    }
    nearest = subgroupMin(nearest);
    uint radius = map == kNoCluster ? 0 : max(maps.items[min(map, push.settings.mapCount - 1)].candidateRadius, nearest);
    bool any = map != kNoCluster && nearest < (1u << 20);

    uint found = 0;
    for (uint base = 0; base < count; base += kSubgroupSize) {
        uint cluster = base + gl_SubgroupInvocationID;
        bool take = any && cluster < count && tileDistance(min(cluster, count - 1), place, map) <= radius;
        uvec4 ballot = subgroupBallot(take);
        uint slot = found + subgroupBallotExclusiveBitCount(ballot);
        take = take && slot < kMaxCandidates;
        if (take) candidates.items[tile * kMaxCandidates + slot] = cluster;
        if (cluster < count) slotOfCluster.items[tile * count + cluster] = take ? slot : kNoCluster;
        found += subgroupBallotBitCount(ballot);
    }
    if (gl_SubgroupInvocationID == 0) candidateCounts.items[tile] = min(found, kMaxCandidates);
}
