// Points spread over the scene's surfaces by area (ACRSM section 5.1.3; Ritschel et al. 2008), chosen once
// and carried along by their instances. They lie along a curve through all surfaces; segments of it are
// bounded by balls, so that what is near a place can be found.
#pragma once

#include <vector>

#include "gi/inputs.h"
#include "shaders/surface_points/surface_points_io.h"

namespace ag::gi {

// Static points, or those that may move.
struct PointLayer {
    uint32_t count = 0, firstSegment = 0, segmentCount = 0;
};

struct SurfacePoints {
    BufferHandle points;    // io::SurfacePoint; also a texel buffer of vec4
    BufferHandle segments;  // io::SurfaceSegment; also a texel buffer of vec4
    uint32_t count = 0;
    PointLayer staticLayer, movableLayer;  // in this order; no segment has points of both
    uint64_t staticVersion = 0;            // changes when a point of `staticLayer` may have moved
    float extent = 0;                      // m: no two points are farther apart
};

// `instancesVersion`: changes when any instance may have moved.
SurfacePoints addSurfacePoints(GraphScope scope, const Occluders& occluders, uint64_t instancesVersion);

// The bindings of a shader with AG_SKINNED; none if nothing is bent by joints.
void readDeformed(PassBuilder& pass, const Occluders& occluders);

}  // namespace ag::gi
