// Which of the points on the scene's surfaces stand for them when light bounces on: a pure function of those.
#pragma once

#include <vector>

#include "gi/surface_sampling.h"
#include "shaders/later_bounces/later_bounces_io.h"

namespace ag::gi {

// `count` of them at equal steps along the samples' curve, with the area and the mean albedo of what each
// stands for: `albedoAt` of an instance about a place of its texture. Those of double-sided surfaces face one
// side and the other in turn, for the area of both. Those that joints bend have their normals from the
// device: they face the front.
using AlbedoAt = FunctionRef<glm::vec3(uint32_t instance, glm::vec2 uv)>;
std::vector<io::BouncePoint> chooseBouncePoints(std::span<const SampledInstance> instances,
                                                const SurfaceSamples& samples, AlbedoAt albedoAt,
                                                FunctionRef<bool(uint32_t instance)> doubleSided,
                                                uint32_t count);

// Of a double-sided surface's point: to one of its sides, for the area of both.
void faceSide(io::BouncePoint& point, bool back);

// m² that a point stands for in the mean; 0: there are none.
float meanArea(std::span<const io::BouncePoint> points);
// Of points that shine, W, mean of the channels.
float emittedFlux(std::span<const io::BouncePoint> shining);

}  // namespace ag::gi
