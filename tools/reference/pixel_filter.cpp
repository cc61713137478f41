#include "tools/reference/pixel_filter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace ag::reference {
namespace {

constexpr std::array<std::string_view, 3> kNames = {"center", "box", "blackman-harris"};

// Four-term Blackman-Harris window (Harris 1978) over [-radius, radius].
constexpr double kRadius = 1.5;  // pixels

double window(double x) {
    const double t = 2 * std::numbers::pi * (x / (2 * kRadius) + 0.5);
    return 0.35875 - 0.48829 * std::cos(t) + 0.14128 * std::cos(2 * t) - 0.01168 * std::cos(3 * t);
}

// Places at even steps of the window's cumulative share.
constexpr size_t kSteps = 1024;

std::array<float, kSteps + 1> inverseShares() {
    constexpr size_t kFine = 1 << 16;
    std::array<float, kSteps + 1> places{};
    double total = 0;
    for (size_t i = 0; i < kFine; ++i)
        total += window(((double(i) + 0.5) / kFine * 2 - 1) * kRadius);
    double sum = 0;
    size_t step = 0;
    for (size_t i = 0; i < kFine && step <= kSteps; ++i) {
        const double share = window(((double(i) + 0.5) / kFine * 2 - 1) * kRadius) / total;
        for (; step <= kSteps && double(step) / kSteps <= sum + share; ++step) {
            const double part = share > 0 ? (double(step) / kSteps - sum) / share : 0;
            places[step] = float(((double(i) + part) / kFine * 2 - 1) * kRadius);
        }
        sum += share;
    }
    for (; step <= kSteps; ++step)
        places[step] = float(kRadius);
    return places;
}

float blackmanHarris(float u) {
    static const std::array<float, kSteps + 1> places = inverseShares();
    const float at = std::clamp(u, 0.0f, 1.0f) * kSteps;
    const size_t i = std::min(size_t(at), kSteps - 1);
    return places[i] + (places[i + 1] - places[i]) * (at - float(i));
}

}  // namespace

std::string_view filterName(PixelFilter filter) {
    return kNames[size_t(filter)];
}

std::optional<PixelFilter> filterFromName(std::string_view name) {
    const auto found = std::ranges::find(kNames, name);
    if (found == kNames.end()) return std::nullopt;
    return PixelFilter(found - kNames.begin());
}

glm::vec2 filterOffset(PixelFilter filter, glm::vec2 uv) {
    switch (filter) {
        case PixelFilter::kCenter:
            return glm::vec2(0);
        case PixelFilter::kBox:
            return uv - 0.5f;
        case PixelFilter::kBlackmanHarris:
            return {blackmanHarris(uv.x), blackmanHarris(uv.y)};
    }
    return glm::vec2(0);
}

}  // namespace ag::reference
