// Irradiance by path tracing with next-event estimation: the truth that every technique is held against.
// Lambert surfaces, pixel centres, exact bounce count.
#pragma once

#include "engine/core/function_ref.h"
#include "engine/core/image.h"
#include "engine/jobs/job_graph.h"
#include "tools/reference/ray_scene.h"

namespace ag::reference {

struct PathSettings {
    uint32_t bounces = 1;  // most; 0: direct light alone
    uint32_t samplesPerPixel = 64;
    uint32_t seed = 1;
};

// All layers of one camera image. Irradiance in W/m² on the shading normal, before albedo.
struct ReferenceImages {
    Image direct;    // bounce 0
    Image bounce1;   // exactly one bounce
    Image indirect;  // all bounces from the first to the last
    Image albedo, normal, depth, emissive;
    Image irradiance() const;  // direct and indirect
    Image radiance() const;    // albedo / pi x irradiance + emission
    uint64_t rays = 0;
};

// Direct irradiance at a surface from every light, with shadow rays.
glm::vec3 directIrradiance(const RayScene& scene, const Surface& surface, uint64_t& rays);

// `progress` is called now and then with the share that is done.
ReferenceImages tracePaths(const RayScene& scene, glm::uvec2 size, const PathSettings& settings,
                           JobRunner& runner, FunctionRef<void(double)> progress);

}  // namespace ag::reference
