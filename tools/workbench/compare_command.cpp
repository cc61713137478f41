#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <limits>
#include <nlohmann/json.hpp>

#include "engine/core/flip.h"
#include "engine/core/number_option.h"
#include "engine/core/safe_file.h"
#include "tools/workbench/commands.h"

namespace ag::workbench {
namespace {

struct CompareOptions {
    std::string truth, test, heatmap;
    double most = std::numeric_limits<double>::infinity();
};

// Where and which way B is off: red too bright, blue too dark, full at the truth's mean, black none.
Image heatmapOf(const Image& truth, const Image& test) {
    double mean = 0;
    for (const glm::vec3& p : truth.pixels)
        mean += double(p.x + p.y + p.z) / (3.0 * double(truth.pixels.size()));
    Image out(truth.width, truth.height);
    for (size_t i = 0; i < out.pixels.size(); ++i) {
        const glm::vec3 d = test.pixels[i] - truth.pixels[i];
        const float share = std::clamp((d.x + d.y + d.z) / 3 / float(std::max(mean, 1e-30)), -1.0f, 1.0f);
        const float strength = std::sqrt(std::abs(share));  // small errors shall be seen
        out.pixels[i] = (share > 0 ? glm::vec3(1, 0.25f, 0.1f) : glm::vec3(0.15f, 0.4f, 1)) * strength;
    }
    return out;
}

int runCompare(const CompareOptions& o) {
    if (const Status writable = checkWritable({o.heatmap}); !writable)
        return refuse(writable.error().message);
    const auto truth = loadImage(o.truth);
    if (!truth) return refuse(truth.error().message);
    const auto test = loadImage(o.test);
    if (!test) return refuse(test.error().message);
    const auto difference = compareImages(*truth, *test);
    if (!difference) {
        std::cerr << "afterglow: " << difference.error().message << '\n';
        return 1;
    }
    nlohmann::ordered_json out = {{"mean_ratio", difference->meanRatio},
                                  {"rmse", difference->rmse},
                                  {"rel_rmse", difference->relativeRmse},
                                  {"rel_mse", difference->relMse},
                                  {"p99", difference->p99},
                                  {"flip", meanFlip(*truth, *test)}};
    if (const auto noise = truth->attributes.find("noise"); noise != truth->attributes.end())
        out["noise_floor"] = parseNumber(noise->second).value_or(0);
    for (const auto& [name, image] : {std::pair("filter_a", &*truth), {"filter_b", &*test}})
        if (const auto filter = image->attributes.find("filter"); filter != image->attributes.end())
            out[name] = filter->second;
    std::cout << out.dump(2) << '\n';
    if (!o.heatmap.empty())
        if (const Status saved = saveImage(heatmapOf(*truth, *test), o.heatmap); !saved)
            return refuse(saved.error().message);
    return difference->relativeRmse <= o.most ? 0 : 1;
}

}  // namespace

void addCompareCommand(CLI::App& program, int& exitCode) {
    const auto o = std::make_shared<CompareOptions>();
    CLI::App* command = program.add_subcommand("compare", "differences of image B from image A as JSON");
    command->add_option("a", o->truth, "EXR or PFM, taken as the truth")->required();
    command->add_option("b", o->test, "EXR or PFM")->required();
    command->add_option("--max-rel-rmse", o->most, "exit with 1 above this relative RMSE")
        ->check(numberFrom(0, 1e30));
    command->add_option("--heatmap", o->heatmap,
                        "FILE.png: red where B is too bright, blue where too dark, full at the mean of A");
    command->callback([o, &exitCode] { exitCode = runCompare(*o); });
}

}  // namespace ag::workbench
