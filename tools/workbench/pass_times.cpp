#include "tools/workbench/pass_times.h"

#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <map>

namespace ag::workbench {
namespace {

void renderFrame(render::Renderer& renderer, const LoadedScene& loaded, const RenderSetup& settings,
                 const FrameGraphOptions& options) {
    renderer.render(loaded.scene, loaded.size, settings.gi, options,
                    [](GraphScope scope, const render::SceneView&, const render::RenderFrame& frame) {
                        scope.output(frame.outputs.display);
                    });
}

}  // namespace

void printTimes(render::Renderer& renderer, const LoadedScene& loaded, const RenderSetup& settings) {
    FrameGraphOptions options = settings.graph;
    options.skip = false;
    options.timing = TimingMode::kProcessCpu;
    std::vector<double> best;
    constexpr int kRepeats = 7;
    for (int i = 0; i < kRepeats; ++i) {
        renderFrame(renderer, loaded, settings, options);
        best.resize(renderer.graph().report().size(), 1e30);
        for (size_t p = 0; p < best.size(); ++p)
            best[p] = std::min(best[p], renderer.graph().report()[p].cpuMs);
    }
    double total = 0;
    std::cout << fmt::format("{}: {}x{}, process CPU ms per pass, least of {}\n",
                             renderer.device().info().name, loaded.size.x, loaded.size.y, kRepeats);
    for (size_t p = 0; p < best.size(); ++p) {
        if (renderer.graph().report()[p].outcome != PassOutcome::kRan) continue;
        std::cout << fmt::format("{:<36} {:8.2f}\n", renderer.graph().report()[p].name, best[p]);
        total += best[p];
    }
    std::cout << fmt::format("{:<36} {:8.2f}\n{:<36} {:8.1f} MiB\n", "sum", total, "device memory",
                             double(renderer.deviceBytes()) / 1048576.0);
}

void printTimesOfWalk(render::Renderer& renderer, LoadedScene& loaded, const RenderSetup& settings,
                      glm::vec3 step) {
    FrameGraphOptions options = settings.graph;
    options.timing = TimingMode::kProcessCpu;
    constexpr int kFrames = 40;
    std::vector<std::string> names;
    std::map<std::string, double> sums;
    for (int i = 0; i < kFrames; ++i) {
        shiftCamera(loaded.scene, step);
        renderFrame(renderer, loaded, settings, options);
        for (const PassReport& pass : renderer.graph().report()) {
            const auto [entry, added] = sums.try_emplace(std::string(pass.name), 0.0);
            if (added) names.push_back(entry->first);
            if (pass.outcome == PassOutcome::kRan) entry->second += pass.cpuMs / kFrames;
        }
    }
    double total = 0;
    std::cout << fmt::format("{}: {}x{}, process CPU ms per pass, mean of {} frames of a walk\n",
                             renderer.device().info().name, loaded.size.x, loaded.size.y, kFrames);
    for (const std::string& name : names) {
        if (sums[name] > 0) std::cout << fmt::format("{:<36} {:8.2f}\n", name, sums[name]);
        total += sums[name];
    }
    std::cout << fmt::format("{:<36} {:8.2f}\n", "sum", total);
}

}  // namespace ag::workbench
