// Where the first bounce's error comes from: the renderer's own area lights and texels, with one thing after
// another replaced by its truth. What a stage leaves out of the error of the stage before is what that thing
// costs.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "tools/bench/area_light_set.h"
#include "tools/bench/reference_cache.h"

namespace ag::bench {

enum class Stage : uint32_t {
    kRendered,            // today
    kEveryPixel,          // the same lights and maps at every pixel, by the ladder itself
    kCentreRay,           // a traced ray to each light's centre instead of its map
    kTexelRays,           // the share of its texels that traced rays see
    kTexels,              // each texel a disk by itself, seen along a traced ray
    kNearTexels,          // so near lights alone; far ones as at kEveryPixel
    kNearTexelsCentreRay  // the same, far ones as at kCentreRay
};
constexpr size_t kStages = 7;
constexpr std::array<std::string_view, kStages> kStageNames = {
    "today",
    "the same at every pixel, on the CPU",
    "the same lights, one traced ray to each light's centre",
    "the same lights, traced soft visibility of their texels",
    "each texel by itself, traced",
    "today, near lights by their texels, traced",
    "the same, far lights by one traced ray to the centre"};

// A receiver is near a light within this many times the distance of its farthest corner.
constexpr float kNearReaches = 1.5f;

struct LadderOptions {
    glm::uvec2 size{320, 180};
    uint32_t clusterings = 3;  // errors are means over so many
    reference::ReferenceSettings reference;
};

struct Ladder {
    std::string scene;
    glm::uvec2 size{0};
    double noise = 0;       // relative RMSE of the references' mean
    double nearTexels = 0;  // of the lights near to a pixel, in the mean
    double nearRays = 0;    // of those, ones that may send light there: each is a ray
    std::array<ImageDifference, kStages> errors{};
};

// By stage, each drawn twice: stages that draw texels by chance otherwise the second time, so that the noise
// of that cancels. W/m².
struct LadderImages {
    std::array<std::vector<Image>, kStages> images;
    double nearTexels = 0, nearRays = 0;  // as of Ladder
    TwoEstimates of(Stage stage) const { return {images[size_t(stage)][0], images[size_t(stage)][1]}; }
};
LadderImages climbLadder(const reference::RayScene& scene, const reference::FirstHits& hits,
                         const AreaLightSet& set, const gi::BounceLightSettings& settings, JobRunner& runner);

// The first bounce of the technique `afterglow` at its defaults, against two references whose noise cancels;
// stages that draw texels by chance are drawn twice, so that theirs does. Fails with a sentence where the
// scene has no light that bounces.
Result<Ladder> measureLadder(gpu::Device& device, const RenderScene& scene, const LadderOptions& options,
                             ReferenceCache& cache, JobRunner& runner, FunctionRef<void(double)> progress);

std::string ladderToMarkdown(const Ladder& ladder, std::string_view device);
std::string laddersToJson(const std::vector<Ladder>& ladders, std::string_view device);

}  // namespace ag::bench
