#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Evaluation of a map's clusters (ACRSM section 4.8): a random part of them is looked at each step; those with far more
// than the mean error are split, those with far less give up their place for it. Difference: what is compared is not
// area times importance but an estimate of the error itself (evaluate.comp), a mixture of that of flux and that in the
// view, each over its mean. One group of lanes a map, in index order: equal inputs give equal plans.
#include "common/clustering_metric.h"
#include "common/lanes.glsl"
#include "common/sampling.h"
#include "common/texels.glsl"
#include "rsm/rsm.glsl"
#include "val_clustering/val_clustering_io.h"

layout(push_constant, scalar) uniform Push { ClusterSettings settings; } push;

layout(set = 0, binding = 0, scalar) readonly buffer Previous { Cluster items[]; } previous;
layout(set = 0, binding = 1, scalar) readonly buffer PreviousExtents { ClusterExtent items[]; } extents;
layout(set = 0, binding = 2, scalar) uniform Maps { RsmMap items[kMaxRsmMaps]; } maps;
layout(set = 0, binding = 3) VEC4_TEXELS(texels);
layout(set = 0, binding = 5, scalar) readonly buffer Errors { ClusterError items[]; } errors;
layout(set = 0, binding = 4, scalar) writeonly buffer Plans { uint items[]; } plans;

const float kMergeShare = 0.1, kSplitShare = 2.0;  // of the mean error
const float kLeastTexels = 8.0;

shared uint emptySlots[kMaxClusters], idleSlots[kMaxClusters], splitters[kMaxClusters];

bool isLive(Cluster c, uint mapId) { return c.texelCount > 0.0 && c.mapId == mapId; }

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

#define AG_APPEND(list, mine, size, value) { LaneVote vote = laneVote(mine); \
    if (mine) list[size + vote.before] = value; size += vote.count; }

void main() {
    RsmMap map = maps.items[gl_WorkGroupID.x];
    vec2 sum = vec2(0.0);
    float live = 0.0;
    for (uint base = 0; base < map.clusterCount; base += kLanes) {
        uint i = base + laneIndex(), cluster = map.firstCluster + min(i, map.clusterCount - 1);
        if (i < map.clusterCount && isLive(previous.items[cluster], map.id)) {
            sum += vec2(errors.items[cluster].ofFlux, errors.items[cluster].ofView);
            live += 1.0;
        }
    }
    sum = laneAdd(sum);
    float w = sum.y > 0.0 ? push.settings.viewWeight : 0.0;
    vec2 overMean = vec2(1.0 - w, w) * laneAdd(live) / max(sum, vec2(1e-30));

    uint emptyCount = 0, idleCount = 0, splitCount = 0;
    for (uint base = 0; base < map.clusterCount; base += kLanes) {
        uint i = base + laneIndex(), cluster = map.firstCluster + min(i, map.clusterCount - 1);
        Cluster c = previous.items[cluster];
        bool mine = i < map.clusterCount, lit = mine && isLive(c, map.id);
        bool looked = lit && push.settings.lookPeriod > 0 &&
                      hashUint(cluster * 31 + push.settings.step * 7919) % max(push.settings.lookPeriod, 1) == 0;
        float error = dot(overMean, vec2(errors.items[cluster].ofFlux, errors.items[cluster].ofView));
        if (mine) plans.items[cluster] = lit ? kPlanKeep : kPlanAnew;
        AG_APPEND(emptySlots, (mine && !lit), emptyCount, cluster)
        AG_APPEND(idleSlots, (looked && error < kMergeShare), idleCount, cluster)
        AG_APPEND(splitters, (looked && error > kSplitShare && c.texelCount >= kLeastTexels), splitCount, cluster)
    }
    laneBarrier();
    uint pairs = min(splitCount, emptyCount + idleCount);
    for (uint i = laneIndex(); i < pairs; i += kLanes) {
        uint slot = i < emptyCount ? emptySlots[i] : idleSlots[i - emptyCount];
        plans.items[slot] = seedTexel(splitters[i]);
    }
}
