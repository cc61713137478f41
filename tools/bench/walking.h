// What a moving camera costs in steadiness: frames of a short walk beside what is seen standing still at the
// same places.
#pragma once

#include "engine/core/function_ref.h"
#include "engine/core/image.h"
#include "engine/scene/render_scene.h"

namespace ag::bench {

constexpr uint32_t kWalkFrames = 32;
constexpr uint32_t kWalkStops = 4;  // of which as many are compared, at equal steps

// The camera at frame `frame` of the walk: a two-hundredth of the scene's diagonal in all along its way of
// looking, and a turn of eight degrees.
void placeOnWalk(RenderScene& scene, const RenderScene& start, glm::uvec2 size, uint32_t frame);

struct Walking {
    double flicker =
        0;  // mean over the pixels of the deviation over time of walking minus standing, over the mean
    double ghosting =
        0;  // what stays of the difference when noise is blurred away (9 x 9 pixels), over the mean
};
// Parallel, in the order of the walk.
Walking compareWalk(const std::vector<Image>& walking, const std::vector<Image>& standing);

}  // namespace ag::bench
