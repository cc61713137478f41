#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Segmented update, second half: each cluster gathers its sums from the tiles that list it and becomes their
// flux-weighted mean. Flux and area are sums over the texels (not the centre's sample: ACRSM section 4.7 differs).
#include "common/lanes.glsl"
#include "common/texels.glsl"
#include "rsm/rsm.glsl"
#include "val_clustering/covariance.glsl"

layout(push_constant, scalar) uniform Push { ClusterSettings settings; } push;

layout(set = 0, binding = 0, scalar) readonly buffer Seeds { ClusterSeed items[]; } seeds;
layout(set = 0, binding = 1, scalar) uniform Maps { RsmMap items[kMaxRsmMaps]; } maps;
layout(set = 0, binding = 2) UINT_TEXELS(partialOf);
layout(set = 0, binding = 3) VEC4_TEXELS(partials);
layout(set = 0, binding = 4, scalar) writeonly buffer Clusters { Cluster items[]; } clusters;
layout(set = 0, binding = 5, scalar) writeonly buffer Extents { ClusterExtent items[]; } extents;

const int kSumVec4s = 6;

// What stands farther before the centre has less than a ninth of the flux (Chebyshev): a light is not moved for the dark
// underside of a box below it, which faces the same way.
const float kMostDeviations = 3.0;

struct Extreme {  // of a tile's texels in one direction
    float reach;
    uint texel;
};

// The farthest over all lanes; of equals the texel of the lowest index.
uint farthestTexel(Extreme e) {
    bool farthest = e.reach == laneMax(e.reach);
    return laneMin(farthest ? e.texel : 0xffffffffu);
}

const uint kBatch = 256;  // tiles looked through at once
shared uint listing[kBatch];

// Those of a batch of tiles that have texels of the cluster, one after another: most have none.
uint findTiles(uint cluster, uint first, uint tileCount) {
    uint found = 0;
    for (uint base = 0; base < kBatch; base += kLanes) {
        uint tile = first + base + laneIndex();
        bool lists = fetchTexel(partialOf, int(min(tile, tileCount - 1) * push.settings.clusterCount + cluster)).x !=
                     kNoCluster;
        lists = lists && tile < tileCount;
        LaneVote vote = laneVote(lists);
        if (lists) listing[found + vote.before] = tile;
        found += vote.count;
    }
    laneBarrier();
    return found;
}

struct Gathered {
    vec4 sums[kSumVec4s];
    Extreme extremes[kExtremes];
    float before;
    uint nearest, nearestTexel;  // squared distance of bits of a float; of the atlas
};

void addTile(inout Gathered g, uint cluster, uint tile) {
    int at = int(fetchTexel(partialOf, int(tile * push.settings.clusterCount + cluster)).x * kPartialVec4s);
    for (int i = 0; i < kSumVec4s; ++i) g.sums[i] += fetchTexel(partials, at + i);
    g.before = max(g.before, fetchTexel(partials, at + 3).w);
    uint nearest = floatBitsToUint(fetchTexel(partials, at + 5).w), inTile = nearest & (kRsmTileSize * kRsmTileSize - 1);
    if (nearest < g.nearest) g.nearest = nearest, g.nearestTexel = rsmTexelIndex(tile, inTile);
    for (int i = 0; i < int(kExtremes); ++i) {
        float reach = fetchTexel(partials, at + kSumVec4s + i / 4)[i % 4];
        uint texel = rsmTexelIndex(tile, uint(fetchTexel(partials, at + kSumVec4s + 2 + i / 4)[i % 4]));
        if (reach > g.extremes[i].reach) g.extremes[i] = Extreme(reach, texel);
    }
}

Gathered gather(uint cluster) {
    Gathered g;
    for (int i = 0; i < kSumVec4s; ++i) g.sums[i] = vec4(0.0);
    for (int i = 0; i < int(kExtremes); ++i) g.extremes[i] = Extreme(-3.0e38, 0);
    g.before = -3.0e38;
    g.nearest = g.nearestTexel = 0xffffffffu;
    uint tileCount = (push.settings.atlasSize.x / kRsmTileSize) * (push.settings.atlasSize.y / kRsmTileSize);
    for (uint first = 0; first < tileCount; first += kBatch) {
        uint found = findTiles(cluster, first, tileCount);
        for (uint i = laneIndex(); i < found; i += kLanes) addTile(g, cluster, listing[i]);
        laneBarrier();
    }
    return g;
}

void main() {
    uint cluster = gl_WorkGroupID.x;
    Gathered g = gather(cluster);
    vec4 sums[kSumVec4s];
    for (int i = 0; i < kSumVec4s; ++i) sums[i] = laneAdd(g.sums[i]);
    ClusterExtent extent;
    for (int i = 0; i < int(kExtremes); ++i) extent.texels[i] = farthestTexel(g.extremes[i]);
    float before = laneMax(g.before);
    uint nearest = laneMin(g.nearest);
    extent.nearest = laneMin(g.nearest == nearest ? g.nearestTexel : 0xffffffffu);
    if (laneIndex() != 0) return;

    ClusterSeed seed = seeds.items[cluster];
    Cluster c;
    c.flux = sums[0].xyz;
    c.area = sums[0].w;
    c.texelCount = sums[2].w;
    bool empty = c.texelCount == 0.0;
    float invWeight = empty ? 0.0 : 1.0 / max(sums[1].w, 1e-38);
    vec3 offset = sums[1].xyz * invWeight;
    c.position = seed.position + offset;
    vec3 meanNormal = sums[2].xyz * invWeight;
    c.cosineSpread = length(meanNormal);
    c.normal = c.cosineSpread > 1e-6 ? meanNormal / c.cosineSpread : seed.normal;
    c.chroma = empty ? seed.chroma : c.flux / max(length(c.flux), 1e-38);
    c.covarianceDiagonal = max(sums[3].xyz * invWeight - offset * offset, vec3(0.0));
    c.covarianceMixed = sums[4].xyz * invWeight - offset.xxy * offset.yzz;
    c.mapId = maps.items[seed.map].id;
    c.map = seed.map;
    c.age = seed.age;
    clusters.items[cluster] = c;
    float deviation = sqrt(max(dot(c.normal, covarianceOf(c) * c.normal), 0.0));
    extent.before = clamp(before - dot(offset, seed.normal), 0.0, kMostDeviations * deviation);
    extent.areaCentre = empty ? vec3(0.0) : sums[5].xyz / max(c.area, 1e-38) - offset;
    extent.spare = uint[](0u, 0u, 0u);
    extents.items[cluster] = extent;
}
