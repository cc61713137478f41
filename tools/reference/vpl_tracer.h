// A second estimator of the first bounce that shares nothing with path tracing but the rays: every texel of a
// RSM is a point emitter, seen or not seen from each pixel. That both agree proves the units of
// reflective shadow maps (flux = albedo x incident power, E = flux / pi x cosines / d²).
#pragma once

#include "tools/reference/path_tracer.h"

namespace ag::reference {

struct Emitter {
    glm::vec3 position{0};  // m
    glm::vec3 normal{0, 1, 0};
    glm::vec3 flux{0};          // reflected, W
    double cumulativeFlux = 0;  // W, mean of the channels, of this emitter and all before
};

// One map of `resolution`² texels for a spot or a sun, six for a point light; each texel's ray goes through a
// random place of it, so that maps with other seeds have the true light as their mean.
std::vector<Emitter> traceEmitters(const RayScene& scene, uint32_t resolution, uint32_t seed, uint64_t& rays);

// Which emitters light each pixel: `count`, evenly spread over their flux from a random start; all of them
// once each if `count` is their number.
struct EmitterChoice {
    uint32_t seed = 1, count = 1;
};

// Adds the first bounce from the emitters chosen, as `count` samples.
void addEmitters(const RayScene& scene, const FirstHits& hits, const std::vector<Emitter>& emitters,
                 EmitterChoice choice, JobRunner& runner, LightSums& sums);

}  // namespace ag::reference
