#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// For each tile, in ascending order, the clusters whose seeds lie within its map's candidate radius (RSMC's r = 2 cells
// of a sqrt(k) x sqrt(k) grid, rounded to tiles), and wherever they lie those nearest by the metric to texels here and
// there in the tile: where clusters are few, that of a texel's own surface may be far off while another surface's is
// near. Where no seed is near, the nearest ones: every lit texel finds a cluster. One group of lanes a tile, so that
// the order is fixed.
#include "common/clustering_metric.h"
#include "common/lanes.glsl"
#include "common/texels.glsl"
#include "rsm/rsm.glsl"
#include "val_clustering/val_clustering_io.h"

layout(push_constant, scalar) uniform Push { ClusterSettings settings; } push;

layout(set = 0, binding = 0) VEC4_TEXELS(seeds);
layout(set = 0, binding = 1, scalar) uniform Maps { RsmMap items[kMaxRsmMaps]; } maps;
layout(set = 0, binding = 2, scalar) readonly buffer TileMaps { uint items[]; } tileMaps;
layout(set = 0, binding = 3, scalar) writeonly buffer Candidates { uint items[]; } candidates;
layout(set = 0, binding = 4, scalar) writeonly buffer CandidateCounts { uint items[]; } candidateCounts;
layout(set = 0, binding = 5, scalar) writeonly buffer PartialOf { uint items[]; } partialOf;

layout(set = 0, binding = 6) VEC4_TEXELS(texels);

const uint kProbes = 16;  // of a tile: one a row and a column
const uint kProbesPerLane = (kProbes + kLanes - 1) / kLanes;
const uint kFar = 1u << 20;  // tiles: beyond any map

// Chebyshev distance in tiles; kFar for dead seeds and other maps' clusters.
uint tileDistance(uint cluster, uvec2 tile, uint map) {
    uint seedTile = floatBitsToUint(fetchTexel(seeds, int(cluster) * 3).w);
    uint seedMap = floatBitsToUint(fetchTexel(seeds, int(cluster) * 3 + 1).w);
    uint tilesX = push.settings.atlasSize.x / kRsmTileSize;
    ivec2 d = abs(ivec2(seedTile % tilesX, seedTile / tilesX) - ivec2(tile));
    return seedTile == kNoCluster || seedMap != map ? kFar : uint(max(d.x, d.y));
}

struct Probe {
    RsmSurface s;
    vec3 chroma;
    float metric;
    uint nearest;  // kNoCluster where it is not lit
};

Probe probeOf(uint tile, uint index) {
    uint row = min(index, kProbes - 1);
    Probe p;
    p.s = AG_RSM_FETCH(texels, rsmTexelIndex(tile, row * kRsmTileSize + (row * 5 + 3) % kRsmTileSize));
    p.chroma = p.s.flux * inversesqrt(max(dot(p.s.flux, p.s.flux), 1e-38));
    p.metric = p.s.weight > 0.0 ? 3.0e38 : -1.0;
    p.nearest = kNoCluster;
    return p;
}

// A lane owns probes and loads a cluster of its own in each round, which it hands to the others.
void findNearest(inout Probe probes[kProbesPerLane], uvec2 place, uint map, uint count) {
    for (uint base = 0; base < count; base += kLanes) {
        uint mine = min(base + laneIndex(), count - 1);
        vec3 position = fetchTexel(seeds, int(mine) * 3).xyz, normal = fetchTexel(seeds, int(mine) * 3 + 1).xyz,
             chroma = fetchTexel(seeds, int(mine) * 3 + 2).xyz;
        bool live = tileDistance(mine, place, map) < kFar;
        uint here = min(kLanes, count - base);
        [[dont_unroll]] for (uint lane = 0; lane < here; ++lane) {
            if (!laneShuffle(live, lane)) continue;
            vec3 x = laneShuffle(position, lane), n = laneShuffle(normal, lane), c = laneShuffle(chroma, lane);
            [[unroll]] for (uint i = 0; i < kProbesPerLane; ++i) {
                float metric = clusterMetric(probes[i].s.position, probes[i].s.normal, probes[i].chroma, x, n, c,
                                             push.settings.metricWeights);
                bool nearer = metric < probes[i].metric;
                probes[i].metric = nearer ? metric : probes[i].metric;
                probes[i].nearest = nearer ? base + lane : probes[i].nearest;
            }
        }
    }
}

bool isNearestOfAny(Probe probes[kProbesPerLane], uint cluster) {
    bool found = false;
    [[dont_unroll]] for (uint lane = 0; lane < min(kLanes, kProbes); ++lane)
        [[unroll]] for (uint i = 0; i < kProbesPerLane; ++i) {
            uint nearest = laneShuffle(probes[i].nearest, lane);  // by all lanes, so not behind a ||
            found = found || nearest == cluster;
        }
    return found;
}

void main() {
    uint tile = gl_WorkGroupID.x;
    uint tilesX = push.settings.atlasSize.x / kRsmTileSize;
    uvec2 place = uvec2(tile % tilesX, tile / tilesX);
    uint map = tileMaps.items[tile];
    uint count = push.settings.clusterCount;

    uint nearest = kFar;
    for (uint base = 0; base < count; base += kLanes) {
        uint cluster = base + laneIndex();
        if (cluster < count) nearest = min(nearest, tileDistance(cluster, place, map));
    }
    nearest = laneMin(nearest);
    uint radius = map == kNoCluster ? 0 : max(maps.items[min(map, push.settings.mapCount - 1)].candidateRadius, nearest);
    bool any = map != kNoCluster && nearest < kFar;

    Probe probes[kProbesPerLane];
    for (uint i = 0; i < kProbesPerLane; ++i) probes[i] = probeOf(tile, i * kLanes + laneIndex());
    if (any) findNearest(probes, place, map, count);

    uint found = 0;
    for (uint base = 0; base < count; base += kLanes) {
        uint cluster = base + laneIndex();
        bool take = tileDistance(min(cluster, count - 1), place, map) <= radius;
        bool listed = isNearestOfAny(probes, cluster);
        take = (take || listed) && any && cluster < count;
        LaneVote vote = laneVote(take);
        uint slot = found + vote.before;
        take = take && slot < kMaxCandidates;
        if (take) candidates.items[tile * kMaxCandidates + slot] = cluster;
        if (cluster < count) partialOf.items[tile * count + cluster] = kNoCluster;  // until texels are found
        found += vote.count;
    }
    if (laneIndex() == 0) candidateCounts.items[tile] = min(found, kMaxCandidates);
}
