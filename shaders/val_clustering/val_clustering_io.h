// Clusters of RSM texels and what carries them from frame to frame.
#ifndef AG_VAL_CLUSTERING_IO_H
#define AG_VAL_CLUSTERING_IO_H

#include "common/portable.h"

#ifdef __cplusplus
namespace ag::io {
#endif

const uint kMaxClusters = 1024;
const uint kMaxCandidates = 256;  // a tile considers at most so many clusters
const uint kNoCluster = 0xffffffffu;

// What a step has planned for a cluster's place: keep it, seed it anew, or (any other number) start at that
// texel.
const uint kPlanKeep = 0xffffffffu, kPlanAnew = 0xfffffffeu;
const uint kPartialVec4s = 10;  // what a tile keeps for a cluster it has texels of: 6 of sums, 4 of extremes
const uint kExtremes = 8;       // directions in the seed's plane, 45 degrees apart

struct ClusterSeed {  // 3 vec4: what a texel is compared with
    vec3 position;    // m
    uint tile;        // linear tile index in the atlas; kNoCluster: the seed is dead this frame
    vec3 normal;
    uint map;
    vec3 chroma;  // flux / |flux|
    float age;    // steps since it was seeded
};

struct Cluster {       // 6 vec4: the state after a step
    vec3 position;     // flux-weighted mean, m
    float area;        // sum over its texels, m²
    vec3 normal;       // unit
    float texelCount;  // 0: empty, seeded anew in the next step
    vec3 flux;         // sum over its texels, W
    uint mapId;
    vec3 chroma;
    float age;                // steps since seeded
    vec3 covarianceDiagonal;  // xx yy zz, m², flux-weighted
    uint map;
    vec3 covarianceMixed;  // xy xz yz, m²
    float cosineSpread;    // |mean of normals| before normalising: 1 flat, 0 all round
};

struct ClusterExtent {       // 4 vec4: how far a cluster's texels reach from it
    uint texels[kExtremes];  // the farthest ones, in the directions' order
    float before;            // m, before the plane through the centre
    vec3 areaCentre;         // m, from the centre: the mean of its texels' places by area
    uint nearest;            // the texel nearest to where the cluster was a step ago
    uint spare[3];
};

struct ClusterError {  // what one light instead of its texels gets wrong
    float ofFlux;      // W times the metric of clustering, as far as it faces the view
    float ofView;      // W/m², mean over points of the view
};

struct ClusterSettings {  // push constants
    vec4 metricWeights;   // distance [1/m²], normal, chroma, distance from the plane [1/m²]
    uint clusterCount;
    uvec2 atlasSize;  // texels
    uint mapCount;
    float viewWeight;  // of errors in the view against errors of flux, 0 to 1
    uint lookPeriod;   // adaption looks at a cluster every so many steps, by chance; 0: never
    uint step;         // counts clustering steps: varies the reseeding sequence
};

#ifdef __cplusplus
}  // namespace ag::io
#endif
#endif
