// The moving spot of the ACRSM thesis (figure 6.7): how even clusters stay, and what that costs, while a
// light sweeps from one wall to the next.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/function_ref.h"
#include "engine/gpu/device.h"

namespace ag::bench {

constexpr double kSweepSeconds = 10;

// Clusters left as they were seeded; split and dropped by their flux's error; by their error in the view too.
constexpr std::array<std::string_view, 3> kSweepVariants = {"not adaptive", "adaptive by flux",
                                                            "adaptive by flux and view"};

struct SweepFrame {
    double seconds = 0;
    // A value a variant. Spread: standard deviation of live clusters' areas over their mean. Error: relative
    // RMSE of unshadowed first-bounce irradiance against a gather of all the RSM's texels.
    std::array<double, kSweepVariants.size()> spread{}, error{};
};

struct SweepOptions {
    uint32_t frames = 600;    // of the ten seconds
    uint32_t clusters = 128;  // as in the thesis
    uint32_t every = 5;       // frames between two that are measured
};

std::vector<SweepFrame> sweepSpot(gpu::Device& device, const SweepOptions& options,
                                  FunctionRef<void(double)> progress);
std::string sweepToCsv(const std::vector<SweepFrame>& frames);
std::string sweepToSvg(const std::vector<SweepFrame>& frames);

}  // namespace ag::bench
