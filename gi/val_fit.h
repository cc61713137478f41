// Clusters to virtual area lights about their flux-weighted centres: disks of the cluster's area, rectangles
// of its second moments, and convex polygons of its farthest texels (RSMC section 5).
#pragma once

#include "gi/val_clustering.h"
#include "shaders/val_fit/val_fit_io.h"

namespace ag::gi {

struct Vals {
    BufferHandle vals;  // io::Val; also a texel buffer of vec4
    BufferHandle
        shapes;  // io::ValShapeVectors; also a texel buffer of vec4; invalid for lights that are points
    uint32_t count = 0;  // padded with black lights to whole subgroups
    uint32_t first = 0;  // those before it are left alone

    bool empty() const { return first >= count; }
};

// Room for `count` lights and the padding.
Vals allocateVals(GraphScope scope, std::string_view vals, std::string_view shapes, uint32_t count);

// Of [begin, end) alone.
Vals valsBetween(Vals vals, uint32_t begin, uint32_t end);

// `traced`: occluders that have trees, if the lights may look at them: then none looks out from within a
// solid.
Vals addValFit(GraphScope scope, const RsmSet& rsm, const SurfaceEmitters& emitters, const Clusters& clusters,
               const Occluders* traced);

}  // namespace ag::gi
