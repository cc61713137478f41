// What was measured, and the forms it is given out in.
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/image_difference.h"

namespace ag::bench {

constexpr std::string_view kPathTracing = "path-tracing";

struct Row {
    std::string scene, technique, variant;
    std::map<std::string, std::string> settings;
    glm::uvec2 size{0};
    uint32_t vals = 0;    // virtual area lights; 0: the technique has none
    uint32_t frames = 0;  // that were timed
    double gpuMsMedian = 0, gpuMsP99 = 0;
    double gbufferMs = 0;                   // part of it, shared by all techniques
    double cpuMsMedian = 0;                 // of the host's own work a frame
    std::map<std::string, double> passes;   // ms, median
    std::map<std::string, double> skipped;  // share of frames under a slowly moving light
    uint64_t gpuBytes = 0;
    std::string term;
    ImageDifference error;  // by two references; the mean over the clusterings
    double flip = 0;
    double noiseFloor = 0;                              // relative RMSE of the references' mean itself
    std::optional<double> flickerStill, flickerMoving;  // none: not measured
    std::optional<double> flickerWalking, ghosting;     // see walking.h
    double pathTracingRelRmse = 0;  // of path tracing stopped after this row's time; 0: not traced
    uint32_t clusterings = 1;       // with other seeds, that the errors are the means of
    double relRmseSpread = 0;       // the largest relative RMSE of one less the least
    bool pareto = false;            // nothing in the scene is both faster and nearer to the truth
    // Path tracing for another row's time: a row of its own in the files, a column and a curve elsewhere.
    bool isPathTracing() const { return technique == kPathTracing; }
    double indirectMs() const { return gpuMsMedian - gbufferMs; }
};

struct Report {
    std::string device, driver, commit;
    std::vector<Row> rows;
};

// Per scene and term: rows that no other beats in time and error.
void markPareto(Report& report);

nlohmann::ordered_json rowToJson(const Row& row);
Result<Row> rowFromJson(const nlohmann::json& json);
std::string toJson(const Report& report);
std::string toCsv(const Report& report);
std::string toMarkdown(const Report& report);
// One panel a scene: time of the indirect light against relative RMSE, both logarithmic.
std::string toSvg(const Report& report);

}  // namespace ag::bench
