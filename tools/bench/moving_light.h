// The slow motion under which flicker is measured, the same for every scene, and the reference's trend
// through it.
#pragma once

#include "tools/bench/reference_cache.h"

namespace ag::bench {

constexpr uint32_t kFlickerFrames = 64;  // of the moving light
constexpr uint32_t kStillFrames = 32;    // before it

// Lights at `time` in [0, 1]: spots and suns turn by 4 degrees about the vertical through them, point lights
// go along x by a hundredth of the scene's diagonal.
std::vector<RenderLight> movedLights(const RenderScene& scene, double time);

// The sequence's truth at any time: a polynomial through references at equal steps. They share their random
// numbers, so that noise hardly differs between them and adds no motion of its own.
class ReferenceTrend {
  public:
    static Result<ReferenceTrend> make(ReferenceCache& cache, RenderScene scene, glm::uvec2 size,
                                       reference::ReferenceSettings settings, JobRunner& runner,
                                       FunctionRef<void(double)> progress);
    Image at(double time) const;

  private:
    std::vector<Image> keys_;  // at equal steps from 0 to 1
};

// Mean over the pixels of the temporal standard deviation, over the mean; of frames minus their trend.
double flickerOf(const std::vector<Image>& frames, const ReferenceTrend* trend);

}  // namespace ag::bench
