// Which of the points on the scene's surfaces stand for them when light bounces on: a pure function of the
// scene.
#pragma once

#include <vector>

#include "gi/surface_sampling.h"
#include "shaders/later_bounces/later_bounces_io.h"

namespace ag::gi {

// `count` of them at equal steps along the samples' curve, with the area and the mean albedo of what each
// stands for.
std::vector<io::BouncePoint> chooseBouncePoints(const RenderScene& scene, const SurfaceSamples& samples,
                                                uint32_t count);

}  // namespace ag::gi
