#include "tools/bench/path_tracing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/core/flip.h"
#include "engine/core/image_difference.h"

namespace ag::bench {
namespace {

constexpr double kFirstMs = 5;

}  // namespace

std::vector<Row> tracePathCurve(const reference::RayScene& rays, const reference::PathSettings& paths,
                                const std::string& layer, TwoEstimates truth, JobRunner& runner,
                                uint32_t times) {
    const Image middle = meanOf(truth);
    std::vector<double> seconds;
    for (uint32_t i = 0; i < times; ++i)
        seconds.push_back(kFirstMs * 1e-3 * std::exp2(i));
    std::vector<Row> rows;
    const glm::uvec2 size(middle.width, middle.height);
    traceOverTime(rays, size, paths, seconds, runner, [&](double after, const reference::Reference& traced) {
        Row row{.technique = std::string(kPathTracing), .variant = fmt::format("{:.0f} ms", after * 1e3)};
        row.size = size;
        row.frames = 1;
        row.gpuMsMedian = row.gpuMsP99 = after * 1e3;
        const Image& image = *reference::layerOf(traced, layer);
        if (const auto difference = compareImages(truth, image)) row.error = *difference;
        row.flip = meanFlip(middle, image);
        rows.push_back(row);
    });
    return rows;
}

double errorAfter(std::span<const Row> curve, double ms) {
    if (curve.empty()) return 0;
    const auto error = [](const Row& row) { return row.error.relativeRmse; };
    const auto after = std::ranges::lower_bound(curve, ms, {}, &Row::gpuMsMedian);
    if (after == curve.begin()) return error(curve.front());
    const Row& before = *(after - 1);
    if (after == curve.end()) return error(before) * std::sqrt(before.gpuMsMedian / ms);
    const double along =
        std::log(ms / before.gpuMsMedian) / std::log(after->gpuMsMedian / before.gpuMsMedian);
    return error(before) * std::pow(error(*after) / error(before), along);
}

}  // namespace ag::bench
