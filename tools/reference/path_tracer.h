// Path tracing with next-event estimation, joined with lit points found from the lights (lit_points.h): the
// estimator behind the reference. Exact bounce counts, pixel centres or a filter, Lambert surfaces or the
// whole glTF material.
#pragma once

#include "engine/core/image.h"
#include "engine/jobs/job_graph.h"
#include "tools/reference/lit_points.h"
#include "tools/reference/pixel_filter.h"
#include "tools/reference/ray_scene.h"

namespace ag::reference {

struct PathSettings {
    uint32_t bounces = 1;      // most; 0: direct light alone
    bool glossy = false;       // metallic-roughness with its GGX coat; else the diffuse part as Lambert
    bool unshadowed = false;   // bounced light passes through surfaces; one bounce, no emission
    bool emission = false;     // emissive surfaces light others, too
    glm::vec3 environment{0};  // radiance from where rays meet nothing, W/(m² sr)
    PixelFilter filter = PixelFilter::kCenter;
    bool litPoints = true;  // bounced light is looked for from the lights, too
};

// Bounces that are kept apart; further ones only count in `indirect`.
constexpr uint32_t kBouncesApart = 8;

// What each pixel's centre sees, and the light that falls there straight from the punctual lights.
struct FirstHits {
    explicit FirstHits(glm::uvec2 size);
    glm::uvec2 size;
    std::vector<Surface> surfaces;      // distance 0: nothing there
    std::vector<glm::vec3> directions;  // of the camera's rays, unit
    Image irradiance, radiance;         // direct, W/m² and W/(m² sr)
};

// Sums over `samples` of each pixel. Irradiance on the shading normal, before albedo. At pixel centres direct
// light is FirstHits' and not in here; with a filter all is here.
struct LightSums {
    LightSums(glm::uvec2 size, uint32_t bounces);
    std::vector<Image> bounces;  // [n]: exactly n bounces; [0] holds also emission and environment
    Image indirect;              // all from the first on
    Image radiance;              // towards the camera
    uint32_t samples = 0;
    uint64_t rays = 0;
};

// Every `step`-th pixel both ways from `offset`: 1 takes them all.
struct Lattice {
    uint32_t step = 1;
    glm::uvec2 offset{0};
};

// Which paths: numbers `first` to `first + count` of the stream `seed`, at each pixel of the lattice.
struct PathRange {
    uint32_t seed = 1, first = 0, count = 1;
    Lattice lattice;
};

void traceFirstHits(const RayScene& scene, const PathSettings& settings, const Lattice& lattice,
                    JobRunner& runner, FirstHits& hits, uint64_t& rays);

// Adds the paths to each pixel. `lit`: with the points drawn for them; null: paths alone. What the points
// brought is noted there. Results do not depend on the number of threads.
void addPaths(const RayScene& scene, const FirstHits& hits, const PathSettings& settings,
              const PathRange& range, JobRunner& runner, LightSums& sums, LitPoints* lit = nullptr);

// A point that leaves a surface without meeting it again.
glm::vec3 leaveSurface(const RayScene& scene, const Surface& surface);

// One stream of random numbers (a permuted congruential generator).
struct Random {
    uint64_t state;
    float next();
};

}  // namespace ag::reference
