// How far an RSM texel is from a cluster (RSMC eq. 1, with the distance from the cluster's plane besides,
// weights.w: a light has an outline in its plane, but no thickness). Chroma is flux over its length.
#ifndef AG_CLUSTERING_METRIC_H
#define AG_CLUSTERING_METRIC_H

#include "common/portable.h"

AG_BEGIN

AG_FUNCTION float clusterMetric(vec3 position, vec3 normal, vec3 chroma, vec3 seedPosition, vec3 seedNormal,
                                vec3 seedChroma, vec4 weights) {
    vec3 d = position - seedPosition;
    vec3 c = chroma - seedChroma;
    float offPlane = dot(d, seedNormal);
    return weights.x * dot(d, d) + weights.y * (1.0f - dot(normal, seedNormal)) + weights.z * dot(c, c) +
           weights.w * offPlane * offPlane;
}

AG_END
#endif
