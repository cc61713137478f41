// Choosing points on surfaces: a pure function of the scene.
#pragma once

#include <vector>

#include "engine/scene/render_scene.h"
#include "shaders/surface_points/surface_points_io.h"

namespace ag::gi {

struct SurfaceSamples {
    // Along two curves: neighbours in the list are neighbours in space. First those of all that stands still,
    // whole segments of kSegmentPoints, then those of movable instances.
    std::vector<io::SurfaceSample> samples;
    std::vector<glm::vec2> uvs;  // of the vertices, parallel to the samples
    uint32_t stillCount = 0;
    std::vector<float> pointAreas;  // m², one side: what a point of each of the scene's instances stands for
};

// About `count` points along curves through all surfaces but alpha-blended ones, so that every n-th of any
// stretch is spread evenly over it: at equal steps of area, but no instance is stood for by fewer than 24 as
// long as a quarter of the points suffices for that. The same scene gives the same points.
SurfaceSamples sampleSurfaces(const RenderScene& scene, uint32_t count);

}  // namespace ag::gi
