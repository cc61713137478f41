// Points spread over the scene's surfaces by area (ACRSM section 5.1.3; Ritschel et al. 2008), chosen once
// and carried along by their instances. They lie along a curve through all surfaces; segments of it are
// bounded by balls, so that what is near a place can be found.
#pragma once

#include <vector>

#include "gi/scene_gpu.h"
#include "shaders/surface_points/surface_points_io.h"

namespace ag::gi {

// Points that stand still, or those that may move.
struct PointLayer {
    uint32_t count = 0, firstSegment = 0, segmentCount = 0;
};

struct SurfacePoints {
    BufferHandle points;    // io::SurfacePoint; also a texel buffer of vec4
    BufferHandle segments;  // io::SurfaceSegment; also a texel buffer of vec4
    uint32_t count = 0;
    PointLayer still, moving;   // in this order; no segment has points of both
    uint64_t stillVersion = 0;  // changes when a point of `still` may have moved
    float extent = 0;           // m: no two points are farther apart
};

SurfacePoints addSurfacePoints(GraphScope scope, const SceneView& scene);

}  // namespace ag::gi
