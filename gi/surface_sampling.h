// Choosing points on surfaces: a pure function of the scene.
#pragma once

#include <vector>

#include "engine/scene/render_scene.h"
#include "shaders/surface_points/surface_points_io.h"

namespace ag::gi {

struct SurfaceSamples {
    std::vector<io::SurfaceSample> samples;  // any run of them is spread over everything
    float area = 0;                          // m² of all sampled surfaces, one side
};

// About `count` points, as many on equal areas as can be; none on alpha-blended surfaces. The same scene
// gives the same points.
SurfaceSamples sampleSurfaces(const RenderScene& scene, uint32_t count);

}  // namespace ag::gi
