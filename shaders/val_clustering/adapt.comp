#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_KHR_shader_subgroup_ballot : require
#extension GL_KHR_shader_subgroup_arithmetic : require
// Evaluation of a map's clusters (ACRSM section 4.8): a random third of them is looked at each step; those with far more
// than the mean error are split, those with far less give up their place for it. Difference: what is compared is a
// cluster's flux times its texels' mean distance from it in the clustering's own metric, the error that many small
// clusters would not make. One subgroup a map, in index order: equal inputs give equal plans.
#include "common/clustering_metric.h"
#include "common/lane_loop.glsl"
#include "common/sampling.h"
#include "rsm/rsm.glsl"
#include "val_clustering/val_clustering_io.h"

layout(local_size_x_id = 100) in;
layout(push_constant, scalar) uniform Push { ClusterSettings settings; } push;

layout(set = 0, binding = 0, scalar) readonly buffer Previous { Cluster items[]; } previous;
layout(set = 0, binding = 1, scalar) readonly buffer PreviousExtents { ClusterExtent items[]; } extents;
layout(set = 0, binding = 2, scalar) readonly buffer Maps { RsmMap items[]; } maps;
layout(set = 0, binding = 3) uniform samplerBuffer texels;
layout(set = 0, binding = 4, scalar) writeonly buffer Plans { uint items[]; } plans;

const float kMergeShare = 0.1, kSplitShare = 4.0;  // of the mean error
const float kLeastTexels = 8.0;

shared uint emptySlots[kMaxClusters], idleSlots[kMaxClusters], splitters[kMaxClusters];

bool isLive(Cluster c, uint lightIdLow) { return c.texelCount > 0.0 && c.lightIdLow == lightIdLow; }

float errorOf(Cluster c) {
    vec3 d = c.covarianceDiagonal;
    float distance2 = push.settings.metricWeights.x * (d.x + d.y + d.z);
    return (c.flux.x + c.flux.y + c.flux.z) * (distance2 + push.settings.metricWeights.y * (1.0 - c.cosineSpread));
}

// The worst fitting of the cluster's farthest texels: where its second half starts.
uint seedTexel(uint cluster) {
    Cluster c = previous.items[cluster];
    uint best = kPlanAnew;
    float most = 0.0;
    for (int i = 0; i < int(kExtremes); ++i) {
        uint texel = extents.items[cluster].texels[i];
        RsmSurface s = AG_RSM_FETCH(texels, texel);
        vec3 chroma = s.flux * inversesqrt(max(dot(s.flux, s.flux), 1e-38));
        float metric = clusterMetric(s.position, s.normal, chroma, c.position, c.normal, c.chroma,
                                     push.settings.metricWeights);
        if (s.weight > 0.0 && metric > most) {
            most = metric;
            best = texel;
        }
    }
    return best;
}

#define AG_APPEND(list, mine, count, value) { uvec4 ballot = subgroupBallot(mine); \
    if (mine) list[count + subgroupBallotExclusiveBitCount(ballot)] = value; count += subgroupBallotBitCount(ballot); }

void main() {
    RsmMap map = maps.items[gl_WorkGroupID.x];
    float sum = 0.0, live = 0.0;
    for (uint base = 0; base < map.clusterCount; base += kSubgroupSize) {
        uint i = base + gl_SubgroupInvocationID;
        Cluster c = previous.items[map.firstCluster + min(i, map.clusterCount - 1)];
        if (i < map.clusterCount && isLive(c, map.lightIdLow)) {
            sum += errorOf(c);
            live += 1.0;
        }
    }
    float mean = subgroupAdd(sum) / max(subgroupAdd(live), 1.0);

    uint emptyCount = 0, idleCount = 0, splitCount = 0;
    for (uint base = 0; base < map.clusterCount; base += kSubgroupSize) {
        uint i = base + gl_SubgroupInvocationID, cluster = map.firstCluster + min(i, map.clusterCount - 1);
        Cluster c = previous.items[cluster];
        bool mine = i < map.clusterCount, lit = mine && isLive(c, map.lightIdLow);
        bool looked = lit && hashUint(cluster * 31 + push.settings.step * 7919) % 3 == 0;
        float error = errorOf(c);
        if (mine) plans.items[cluster] = lit ? kPlanKeep : kPlanAnew;
        AG_APPEND(emptySlots, (mine && !lit), emptyCount, cluster)
        AG_APPEND(idleSlots, (looked && error < kMergeShare * mean), idleCount, cluster)
        AG_APPEND(splitters, (looked && error > kSplitShare * mean && c.texelCount >= kLeastTexels), splitCount, cluster)
    }
    memoryBarrierShared();
    subgroupBarrier();
    uint pairs = min(splitCount, emptyCount + idleCount);
    for (uint i = gl_SubgroupInvocationID; i < pairs; i += kSubgroupSize) {
        uint slot = i < emptyCount ? emptySlots[i] : idleSlots[i - emptyCount];
        plans.items[slot] = seedTexel(splitters[i]);
    }
}
