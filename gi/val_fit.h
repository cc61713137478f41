// Clusters to virtual area lights: disks of the cluster's area about its flux-weighted centre.
#pragma once

#include "gi/val_clustering.h"
#include "shaders/val_fit/val_fit_io.h"

namespace ag::gi {

struct Vals {
    BufferHandle vals;   // io::Val; also a texel buffer of vec4
    uint32_t count = 0;  // padded with black lights to whole subgroups
};

Vals addValFit(FrameGraph& graph, const Clusters& clusters);

}  // namespace ag::gi
