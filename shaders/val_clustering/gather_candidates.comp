#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_KHR_shader_subgroup_ballot : require
#extension GL_KHR_shader_subgroup_arithmetic : require
// For each tile, in ascending order, the clusters whose seeds lie within its map's candidate radius (RSMC's r = 2
// cells of a sqrt(k) x sqrt(k) grid, rounded to tiles), and wherever they lie those nearest by the metric to texels here and
// there in the tile: where clusters are few, that of a texel's own surface may be far off while another surface's is near.
// Where no seed is near, the nearest ones: every lit texel finds a cluster. One subgroup a tile, so that the order is fixed.
#include "common/clustering_metric.h"
#include "common/lane_loop.glsl"
#include "rsm/rsm.glsl"
#include "val_clustering/val_clustering_io.h"

layout(local_size_x_id = 100) in;
layout(push_constant, scalar) uniform Push { ClusterSettings settings; } push;

layout(set = 0, binding = 0) uniform samplerBuffer seeds;
layout(set = 0, binding = 1, scalar) uniform Maps { RsmMap items[kMaxRsmMaps]; } maps;
layout(set = 0, binding = 2, scalar) readonly buffer TileMaps { uint items[]; } tileMaps;
layout(set = 0, binding = 3, scalar) writeonly buffer Candidates { uint items[]; } candidates;
layout(set = 0, binding = 4, scalar) writeonly buffer CandidateCounts { uint items[]; } candidateCounts;
layout(set = 0, binding = 5, scalar) writeonly buffer SlotOfCluster { uint items[]; } slotOfCluster;

layout(set = 0, binding = 6) uniform samplerBuffer texels;

const uint kProbes = 16;  // one a row and a column

// Chebyshev distance in tiles; far beyond any map for dead seeds and other maps' clusters.
uint tileDistance(uint cluster, uvec2 tile, uint map) {
    const uint kFar = 1u << 20;
    uint seedTile = floatBitsToUint(texelFetch(seeds, int(cluster) * 3).w);
    uint seedMap = floatBitsToUint(texelFetch(seeds, int(cluster) * 3 + 1).w);
    uint tilesX = push.settings.atlasSize.x / kRsmTileSize;
    ivec2 d = abs(ivec2(seedTile % tilesX, seedTile / tilesX) - ivec2(tile));
    return seedTile == kNoCluster || seedMap != map ? kFar : uint(max(d.x, d.y));
}

// The map's cluster nearest by the metric to each of a tile's probes; kNoCluster where that is not lit.
void findNearestByMetric(uint tile, uvec2 place, uint map, uint count, out uint nearest[kProbes]) {
    float best[kProbes];
    for (int i = 0; i < int(kProbes); ++i) {
        best[i] = 3.0e38;
        nearest[i] = kNoCluster;
    }
    for (uint base = 0; base < count; base += kSubgroupSize) {
        uint cluster = base + gl_SubgroupInvocationID;
        int at = int(min(cluster, count - 1)) * 3;
        vec3 position = texelFetch(seeds, at).xyz, normal = texelFetch(seeds, at + 1).xyz, chroma = texelFetch(seeds, at + 2).xyz;
        bool live = cluster < count && tileDistance(min(cluster, count - 1), place, map) < (1u << 20);
        for (int i = 0; i < int(kProbes); ++i) {
            RsmSurface s = AG_RSM_FETCH(texels, rsmTexelIndex(tile, uint(i) * kRsmTileSize + uint(i * 5 + 3) % kRsmTileSize));
            vec3 own = s.flux * inversesqrt(max(dot(s.flux, s.flux), 1e-38));
            float metric = clusterMetric(s.position, s.normal, own, position, normal, chroma, push.settings.metricWeights);
            bool nearer = live && s.weight > 0.0 && metric < best[i];
            best[i] = nearer ? metric : best[i];
            nearest[i] = nearer ? cluster : nearest[i];
        }
    }
    for (int i = 0; i < int(kProbes); ++i) {
        float least = subgroupMin(best[i]);
        nearest[i] = subgroupMin(best[i] == least ? nearest[i] : kNoCluster);
    }
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

    uint nearestByMetric[kProbes];
    findNearestByMetric(tile, place, map, count, nearestByMetric);
    uint found = 0;
    for (uint base = 0; base < count; base += kSubgroupSize) {
        uint cluster = base + gl_SubgroupInvocationID;
        bool take = tileDistance(min(cluster, count - 1), place, map) <= radius;
        for (int i = 0; i < int(kProbes); ++i) take = take || nearestByMetric[i] == cluster;
        take = take && any && cluster < count;
        uvec4 ballot = subgroupBallot(take);
        uint slot = found + subgroupBallotExclusiveBitCount(ballot);
        take = take && slot < kMaxCandidates;
        if (take) candidates.items[tile * kMaxCandidates + slot] = cluster;
        if (cluster < count) slotOfCluster.items[tile * count + cluster] = take ? slot : kNoCluster;
        found += subgroupBallotBitCount(ballot);
    }
    if (gl_SubgroupInvocationID == 0) candidateCounts.items[tile] = min(found, kMaxCandidates);
}
