// Each cluster's texels, for rays that are drawn to them one by one.
#pragma once

#include "gi/rsm.h"
#include "gi/val_clustering.h"

namespace ag::gi {

struct ClusterMembers {
    BufferHandle ranges, texels;  // first and count of each cluster; indices of texels, cluster by cluster
};

ClusterMembers addClusterMembers(GraphScope scope, const RsmSet& rsm, const Clusters& clusters);

// What a pass reads that draws some of them: memberRanges, members.
void readMembers(PassBuilder& pass, const ClusterMembers& members);

}  // namespace ag::gi
