// Where a picture needs its samples: most of the noise of a dark room is in a few of its pixels. Pixels take
// paths as often as the noise asks that they bring (Neyman 1934), and look at as many places for direct light
// as its share of the noise asks. What one estimate tells places the samples of another: a pixel's mean does
// not depend on how many samples it had.
#pragma once

#include "tools/reference/light_sums.h"

namespace ag::reference {

struct FirstHits;

struct PixelPlan {
    uint8_t every = 1;   // rounds: paths in one of so many; a power of two
    uint8_t places = 1;  // for each path
};

class SamplingPlan {
  public:
    // Paths everywhere in each round; several places where direct light changes from pixel to pixel.
    SamplingPlan(const FirstHits& hits, const PathSettings& settings);
    // By how much another estimate's samples vary.
    void adapt(const LightSums& other);

    const PixelPlan& of(size_t pixel) const { return pixels_[pixel]; }
    // Pixels of a tile take turns together, so that other rounds pass it by.
    bool isDue(size_t pixel, uint32_t round, uint32_t tile) const;

  private:
    const glm::uvec2 size_;
    const float pathCost_;  // of a path, in camera rays with their shadow rays
    std::vector<PixelPlan> pixels_;
};

}  // namespace ag::reference
