// Path tracing on the CPU as one more technique: a curve of its error over time, traced once a scene and
// term.
#pragma once

#include <span>

#include "tools/bench/report.h"
#include "tools/reference/reference.h"

namespace ag::bench {

constexpr uint32_t kPathTimes = 11;  // the last after 5.1 s

// A row a time, from 5 ms on, each twice the one before. What depends on the scene alone is set.
std::vector<Row> tracePathCurve(const reference::RayScene& rays, const reference::PathSettings& paths,
                                const std::string& layer, TwoEstimates truth, JobRunner& runner,
                                uint32_t times = kPathTimes);

// Relative RMSE after so many ms: between rows by logarithms of both, past the last one by the root of time,
// before the first as there. 0: no rows.
double errorAfter(std::span<const Row> curve, double ms);

}  // namespace ag::bench
