// What the machine can trace at best, to hold the reference's speed against.
#pragma once

#include "tools/reference/path_tracer.h"

namespace ag::reference {

// Rays a second of bare Embree calls on all threads, for the rays one-bounce paths shoot in the order they
// shoot them: a cosine-spread ray from what a pixel sees, then a ray from where it lands to each light that
// surface faces. All are laid out beforehand and nothing is shaded.
double bareRaysPerSecond(const RayScene& scene, glm::uvec2 size, JobRunner& runner);

}  // namespace ag::reference
