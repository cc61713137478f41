#include "engine/core/image_difference.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace ag {
namespace {

constexpr double kTrimmed = 0.01;                 // of the pixels
constexpr double kLeakFrom = 5, kLeakWithin = 2;  // of the truth's mean
constexpr double kFloor = 0.01;                   // of it, in denominators

bool finite(const Image& image) {
    return std::ranges::all_of(image.pixels, [](const glm::vec3& p) {
        return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
    });
}

Status checkComparable(TwoEstimates truth, TwoEstimates test) {
    for (const Image* other : {&truth.b, &test.a, &test.b})
        if (truth.a.width != other->width || truth.a.height != other->height)
            return Error{fmt::format("sizes differ: {}x{} and {}x{}", truth.a.width, truth.a.height,
                                     other->width, other->height)};
    if (!finite(truth.a) || !finite(truth.b) || !finite(test.a) || !finite(test.b))
        return Error{"an image holds values that are not finite"};
    return Ok{};
}

double meanOfAll(const Image& image) {
    glm::dvec3 sum(0);
    for (const glm::vec3& p : image.pixels)
        sum += glm::dvec3(p);
    return (sum.x + sum.y + sum.z) / (3 * double(image.pixels.size()));
}

// The square of test - truth; whose noise goes with whose is the same to its mean, so both ways.
double square(double truthA, double truthB, double testA, double testB) {
    return 0.5 * ((testA - truthA) * (testB - truthB) + (testA - truthB) * (testB - truthA));
}

struct Sums {
    double squares = 0, relativeSquares = 0, toneSquares = 0;  // over pixels and channels
    double leaks = 0;
    std::vector<double> pixelSquares;            // sums over channels
    std::vector<float> relative, relativeNoise;  // by pixel: differences, and what noise has in them
};

double root(double meanSquare) {
    return std::sqrt(std::max(meanSquare, 0.0));
}

Sums sumDifferences(TwoEstimates truth, TwoEstimates test, double mean) {
    const double floor = kFloor * std::max(mean, 1e-30);
    const auto tone = [&](double x) { return x > 0 ? x / (x + mean) : 0; };
    Sums s;
    for (size_t i = 0; i < truth.a.pixels.size(); ++i) {
        double pixel = 0, difference = 0, noise = 0, level = 0, shown = 0;
        for (int c = 0; c < 3; ++c) {
            const double a = truth.a.pixels[i][c], b = truth.b.pixels[i][c], x = test.a.pixels[i][c],
                         y = test.b.pixels[i][c], middle = 0.5 * (a + b), middleTest = 0.5 * (x + y);
            const double error = square(a, b, x, y);
            pixel += error;
            s.relativeSquares += error / (middle * middle + floor * floor * 100);
            s.toneSquares += square(tone(a), tone(b), tone(x), tone(y));
            difference += std::abs(middleTest - middle);
            noise += 0.5 * std::abs((x - y) - (a - b));
            level += std::abs(middle);
            shown += middleTest;
        }
        s.squares += pixel;
        s.pixelSquares.push_back(pixel);
        s.relative.push_back(float(difference / (level + 3 * floor)));
        s.relativeNoise.push_back(float(noise / (level + 3 * floor)));
        s.leaks += shown > 3 * kLeakFrom * mean && level < 3 * kLeakWithin * mean;
    }
    return s;
}

// Without the largest: their mean square over pixels and channels.
double trimmedMeanSquare(std::vector<double> pixelSquares) {
    const auto kept = size_t(std::ceil((1 - kTrimmed) * double(pixelSquares.size())));
    const auto end = pixelSquares.begin() + std::ptrdiff_t(kept);
    if (end != pixelSquares.end()) std::nth_element(pixelSquares.begin(), end, pixelSquares.end());
    return std::accumulate(pixelSquares.begin(), end, 0.0) / (3 * double(std::max(kept, size_t(1))));
}

template <class T>
T quantile(std::vector<T>& values, double q) {
    const auto nth = values.begin() + std::ptrdiff_t(q * double(values.size() - 1));
    std::nth_element(values.begin(), nth, values.end());
    return *nth;
}

}  // namespace

Result<ImageDifference> compareImages(TwoEstimates truth, TwoEstimates test) {
    if (const Status comparable = checkComparable(truth, test); !comparable) return comparable.error();
    if (truth.a.pixels.empty()) return Error{"an image has no pixels"};
    const double mean = 0.5 * (meanOfAll(truth.a) + meanOfAll(truth.b)),
                 meanTest = 0.5 * (meanOfAll(test.a) + meanOfAll(test.b));
    Sums s = sumDifferences(truth, test, mean);
    const double count = 3 * double(s.pixelSquares.size());
    const auto overMean = [&](double rmse) { return mean > 0 ? rmse / mean : (rmse == 0 ? 0 : INFINITY); };
    ImageDifference result;
    result.meanRatio = mean > 0 ? meanTest / mean : (meanTest == 0 ? 1 : INFINITY);
    result.rmse = root(s.squares / count);
    result.relativeRmse = overMean(result.rmse);
    result.relMse = s.relativeSquares / count;
    result.p99 = double(quantile(s.relative, 0.99));
    result.toneRmse = root(s.toneSquares / count);
    result.trimmedRelativeRmse = overMean(root(trimmedMeanSquare(std::move(s.pixelSquares))));
    const double median = double(quantile(s.relative, 0.5)), noise = double(quantile(s.relativeNoise, 0.5));
    result.medianRelative = root(median * median - noise * noise);
    result.leakPixels = s.leaks;
    return result;
}

Image meanOf(TwoEstimates picture) {
    Image mean = picture.a;
    for (size_t i = 0; i < mean.pixels.size(); ++i)
        mean.pixels[i] = 0.5f * (picture.a.pixels[i] + picture.b.pixels[i]);
    return mean;
}

std::span<const DifferenceField> differenceFields() {
    static constexpr DifferenceField kFields[] = {{"mean_ratio", &ImageDifference::meanRatio},
                                                  {"rmse", &ImageDifference::rmse},
                                                  {"rel_rmse", &ImageDifference::relativeRmse},
                                                  {"rel_mse", &ImageDifference::relMse},
                                                  {"p99", &ImageDifference::p99},
                                                  {"tone_rmse", &ImageDifference::toneRmse},
                                                  {"rel_rmse_trimmed", &ImageDifference::trimmedRelativeRmse},
                                                  {"median_rel", &ImageDifference::medianRelative},
                                                  {"leak_pixels", &ImageDifference::leakPixels}};
    return kFields;
}

ImageDifference meanOf(std::span<const ImageDifference> items) {
    ImageDifference mean;
    for (const DifferenceField& field : differenceFields())
        for (const ImageDifference& item : items)
            mean.*field.member += item.*field.member / double(items.size());
    return mean;
}

}  // namespace ag
