// References on disk, by a hash of everything they depend on: making one takes minutes, reading one
// milliseconds.
#pragma once

#include <string>

#include "engine/core/function_ref.h"
#include "engine/core/image_difference.h"
#include "engine/core/result.h"
#include "tools/reference/reference.h"

namespace ag::bench {

// Of what is seen: geometry, materials, textures, instances, lights, camera.
uint64_t sceneHash(const RenderScene& scene);
// Settings and the tracer's version, onto `h`.
uint64_t hashSettings(const reference::ReferenceSettings& settings, uint64_t h);

// By two seeds, so that their noise cancels (compareImages).
struct TwoReferences {
    Image a, b;
    double noise = 0;  // relative RMSE of their mean
    TwoEstimates both() const { return {a, b}; }
};

class ReferenceCache {
  public:
    explicit ReferenceCache(std::string folder) : folder_(std::move(folder)) {}

    // settings.layer of the reference; its noise is in the attribute "noise".
    Result<Image> get(const RenderScene& scene, glm::uvec2 size, const reference::ReferenceSettings& settings,
                      JobRunner& runner, FunctionRef<void(double)> progress);
    // With the settings' seed and the next one, each with half the paths: their mean has the noise asked for.
    Result<TwoReferences> getTwo(const RenderScene& scene, glm::uvec2 size,
                                 reference::ReferenceSettings settings, JobRunner& runner,
                                 FunctionRef<void(double)> progress);

  private:
    std::string folder_;
};

// Where references come from: those kept, else traced.
struct ReferenceSource {
    ReferenceCache& cache;
    JobRunner& runner;
};

// $XDG_CACHE_HOME/afterglow/references, or the same under ~/.cache.
std::string defaultCacheFolder();

}  // namespace ag::bench
