// Path tracing with next-event estimation, joined with lit points found from the lights (lit_points.h): the
// estimator behind the reference. Exact bounce counts, pixel centres or a filter, Lambert surfaces or the
// whole glTF material.
#pragma once

#include "engine/core/image.h"
#include "engine/jobs/job_graph.h"
#include "tools/reference/light_sums.h"
#include "tools/reference/lit_points.h"
#include "tools/reference/path_settings.h"
#include "tools/reference/sampling_plan.h"

namespace ag::reference {

// What each pixel's centre sees, and the light that falls there straight from the lights.
struct FirstHits {
    explicit FirstHits(glm::uvec2 size);
    glm::uvec2 size;
    std::vector<Surface> surfaces;      // distance 0: nothing there
    std::vector<glm::vec3> directions;  // of the camera's rays, unit
    Image irradiance, radiance;         // direct, W/m² and W/(m² sr)
};

// Every `step`-th pixel both ways from `offset`: 1 takes them all.
struct Lattice {
    uint32_t step = 1;
    glm::uvec2 offset{0};
};

// Which paths: the next `count` of the stream `seed` at each pixel of the lattice that the plan asks for.
struct PathRound {
    uint32_t seed = 1, number = 0, count = 1;
    Lattice lattice;
    const SamplingPlan* plan = nullptr;  // null: at each pixel, one place a path
    // Drawn for this round and joined with its paths; what they bring is noted there. Null: paths alone.
    LitPoints* lit = nullptr;
};

void traceFirstHits(const RayScene& scene, const PathSettings& settings, const Lattice& lattice,
                    JobRunner& runner, FirstHits& hits, uint64_t& rays);

// Adds the paths to each pixel. Results do not depend on the number of threads.
void addPaths(const RayScene& scene, const FirstHits& hits, const PathSettings& settings,
              const PathRound& round, JobRunner& runner, LightSums& sums);

}  // namespace ag::reference
