// How far an image is from the truth, in numbers that say different things of the same pixels.
#pragma once

#include <span>

#include "engine/core/image.h"

namespace ag {

// Of linear values (irradiance, radiance), over all pixels and channels; m is the truth's mean over both.
// Products of differences stand for squares where there are two estimates of the truth: see compareImages.
struct ImageDifference {
    double meanRatio = 0;  // mean(test) / m
    double rmse = 0;
    double relativeRmse = 0;         // rmse / m
    double relMse = 0;               // mean of (test - truth)² / (truth² + 0.01 m²)
    double p99 = 0;                  // 99th percentile of |test - truth| / (truth + 0.01 m), by pixel
    double toneRmse = 0;             // RMSE of x / (x + m): bright pixels cannot outweigh the rest
    double trimmedRelativeRmse = 0;  // without the 1 % of the pixels that are farthest off
    double medianRelative = 0;       // median of |test - truth| / (truth + 0.01 m), by pixel
    double leakPixels = 0;           // brighter than 5 m where the truth is below 2 m, means over channels
};

// All of them with the names that files and the command line give them.
struct DifferenceField {
    const char* name;
    double ImageDifference::*member;
};
std::span<const DifferenceField> differenceFields();

// A picture by two estimates whose noise is independent; the same one twice where there are no others.
struct TwoEstimates {
    const Image& a;
    const Image& b;
    TwoEstimates(const Image& only) : a(only), b(only) {}
    TwoEstimates(const Image& first, const Image& second) : a(first), b(second) {}
};

// With the truth by two seeds a, b, and an image x, the mean of (x - a)(x - b) is the mean square error
// without the noise of a and b: their noise is independent of each other and of x. If x has noise of its own,
// two estimates of it cancel that, too. With one estimate each, all numbers are of the pixels as they are,
// noise and all.
//   Unbiased: both means in meanRatio; rmse² and relativeRmse² (a negative rest counts as 0).
//   Nearly: toneRmse² (x / (x + m) is curved over the noise); relMse (its denominators hold the estimates'
// mean).
//   Partly: medianRelative² is the median² of the means' differences less that of the half differences; up to
// a third too low where noise outweighs the error.
//   Not: trimmedRelativeRmse, p99, leakPixels.
// Fails when sizes differ or a value is not finite.
Result<ImageDifference> compareImages(TwoEstimates truth, TwoEstimates test);

// Pixel by pixel.
Image meanOf(TwoEstimates picture);
// Field by field.
ImageDifference meanOf(std::span<const ImageDifference> items);

}  // namespace ag
