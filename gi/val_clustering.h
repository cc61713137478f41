// RSM clustering (Prutkin, Kaplanyan, Dachsbacher 2012): one assignment and update of k-means a frame,
// clusters carried over in world space, empty ones seeded anew by importance. Differences: flux and area are
// sums over a cluster's texels; candidates are found by 16x16 tiles instead of a sqrt(k) grid; the update is
// a segmented sum in a fixed order, so that equal inputs give equal bits.
#pragma once

#include "engine/core/setting_fields.h"
#include "gi/importance.h"
#include "gi/settling.h"
#include "shaders/val_clustering/val_clustering_io.h"

namespace ag::gi {

struct ValClusteringSettings {
    uint32_t count = 128;        // clusters over all bounce lights, 16 to 1024
    float distanceWeight = 1;    // w_d, 1/m²
    float normalWeight = 10;     // w_n
    float chromaWeight = 5;      // w_flux of RSMC eq. 1
    float planeWeight = 12;      // of the distance from the cluster's plane, 1/m²
    bool adaptive = true;        // split clusters with much error, drop those with little (ACRSM 4.8)
    uint32_t settleFrames = 32;  // steps taken after the RSMs last changed; then clusters rest
    uint32_t seed = 0;           // other places to start from: another of many arrangements

    static constexpr auto fields() {
        return std::tuple{SettingField{"count", &ValClusteringSettings::count, 16, 1024, "clusters",
                                       "clusters over all bounce lights"},
                          SettingField{"distance_weight", &ValClusteringSettings::distanceWeight, 0, 1000,
                                       "1/m2", "metric: squared distance"},
                          SettingField{"normal_weight", &ValClusteringSettings::normalWeight, 0, 1000, "",
                                       "metric: 1 - cosine of the normals"},
                          SettingField{"chroma_weight", &ValClusteringSettings::chromaWeight, 0, 1000, "",
                                       "metric: squared difference of flux colour"},
                          SettingField{"plane_weight", &ValClusteringSettings::planeWeight, 0, 1000, "1/m2",
                                       "metric: squared distance from the plane"},
                          SettingField{"adaptive", &ValClusteringSettings::adaptive, 0, 0, "",
                                       "split clusters with much error, drop those with little"},
                          SettingField{"settle_frames", &ValClusteringSettings::settleFrames, 0, 1000,
                                       "frames", "clustering steps after the RSMs last changed"},
                          SettingField{"seed", &ValClusteringSettings::seed, 0, 1000, "",
                                       "of where clusters start: another of many arrangements"}};
    }

    bool operator==(const ValClusteringSettings&) const = default;
};

// The part of clustering's state that lives on the CPU: when it may rest, and how often it splits.
struct ValClusteringHistory {
    Settling settling;
    uint64_t lightVersion = 0;  // of the inputs that are not the view
    bool lightMoves = false;
    uint32_t sinceTurn = 0;  // frames since a light started or stopped moving
};

glm::vec4 metricWeights(const ValClusteringSettings& settings);

struct Clusters {
    BufferHandle clusters;                     // io::Cluster
    BufferHandle extents;                      // io::ClusterExtent
    BufferHandle seeds;                        // io::ClusterSeed the texels were compared with
    BufferHandle candidates, candidateCounts;  // per tile: cluster indices, how many
    BufferHandle slotOfTexel;                  // per texel: place in its tile's candidates, ~0 unlit
    // Per tile and cluster which of the sums over a tile's texels is theirs, ~0 none; these, kPartialVec4s
    // each.
    BufferHandle partialOf, partials;
    uint32_t mostPartials = 0;
    uint32_t count = 0;
};

Clusters addValClustering(GraphScope scope, const RsmSet& rsm, const Importance& importance,
                          const ValClusteringSettings& settings, uint64_t viewVersion,
                          ValClusteringHistory& history);

}  // namespace ag::gi
