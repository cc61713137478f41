// The FLIP difference between pictures as an observer sees them flip: LDR-FLIP (Andersson et al. 2020) and
// HDR-FLIP (Andersson et al. 2021), written from the papers.
#pragma once

#include "engine/core/image.h"

namespace ag {

// The papers' observer: 0.7 m from a screen 0.7 m wide with 3840 pixels.
constexpr float kFlipPixelsPerDegree = 67.0206f;

// Error in [0, 1] of each pixel between linear display colours in [0, 1], the sizes being equal.
std::vector<float> flipLdr(const Image& truth, const Image& test,
                           float pixelsPerDegree = kFlipPixelsPerDegree);

// Exposures in stops at which HDR-FLIP looks at a picture: from the brightest pixel just short of white to
// the median there. A median below 2^-16 of the brightest counts as that much.
struct FlipExposures {
    float first = 0, last = 0;
    int count = 2;
    float at(int i) const { return first + (last - first) * float(i) / float(count - 1); }
};
FlipExposures flipExposures(const Image& truth);

// Error in [0, 1] of each pixel between linear radiances: the worst over the exposures.
std::vector<float> flipHdr(const Image& truth, const Image& test,
                           float pixelsPerDegree = kFlipPixelsPerDegree);

// Mean of flipHdr over the pixels.
double meanFlip(const Image& truth, const Image& test);

}  // namespace ag
