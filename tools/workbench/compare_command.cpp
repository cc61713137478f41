#include <iostream>
#include <limits>
#include <nlohmann/json.hpp>

#include "engine/core/image.h"
#include "tools/workbench/commands.h"

namespace ag::workbench {
namespace {

int runCompare(const std::string& truthPath, const std::string& testPath, double most) {
    const auto truth = loadImage(truthPath);
    if (!truth) return refuse(truth.error().message);
    const auto test = loadImage(testPath);
    if (!test) return refuse(test.error().message);
    const auto difference = compareImages(*truth, *test);
    if (!difference) {
        std::cerr << "afterglow: " << difference.error().message << '\n';
        return 1;
    }
    const nlohmann::json out = {{"mean_ratio", difference->meanRatio},
                                {"rmse", difference->rmse},
                                {"rel_rmse", difference->relativeRmse},
                                {"rel_mse", difference->relMse},
                                {"p99", difference->p99}};
    std::cout << out.dump(2) << '\n';
    return difference->relativeRmse <= most ? 0 : 1;
}

}  // namespace

void addCompareCommand(CLI::App& program, int& exitCode) {
    struct Options {
        std::string truth, test;
        double most = std::numeric_limits<double>::infinity();
    };
    const auto o = std::make_shared<Options>();
    CLI::App* command = program.add_subcommand("compare", "differences of image B from image A as JSON");
    command->add_option("a", o->truth, "EXR or PFM, taken as the truth")->required();
    command->add_option("b", o->test, "EXR or PFM")->required();
    command->add_option("--max-rel-rmse", o->most, "exit with 1 above this relative RMSE");
    command->callback([o, &exitCode] { exitCode = runCompare(o->truth, o->test, o->most); });
}

}  // namespace ag::workbench
