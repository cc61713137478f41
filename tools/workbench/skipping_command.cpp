#include <fmt/format.h>

#include <iostream>

#include "engine/core/near_name.h"
#include "tools/bench/skipping.h"
#include "tools/workbench/commands.h"
#include "tools/workbench/progress_line.h"
#include "tools/workbench/scene_options.h"
#include "tools/workbench/text_file.h"

namespace ag::workbench {
namespace {

struct SkippingArguments {
    std::vector<std::string> scenes = {"cornell", "gallery"};
    std::string size = "640x360", preset = "afterglow", plot, markdown;
    bool passes = false;
};

void printPasses(const bench::SceneCosts& costs) {
    for (size_t i = 0; i < costs.changes.size(); ++i) {
        std::cout << fmt::format("  {}:\n", bench::changeName(bench::Change(i)));
        for (const auto& [pass, cost] : costs.changes[i].passes)
            std::cout << fmt::format("    {:<32} {:8.2f} CPU ms   {:3.0f} % of frames\n", pass, cost.cpuMs,
                                     100 * cost.ranIn);
    }
}

int runSkipping(const SkippingArguments& o) {
    render::RenderSettings settings;
    if (!render::applyPreset(o.preset, settings))
        return refuse(missingName("preset", o.preset, render::presetNames()));
    if (const Status ready = prepareTextFiles({o.plot, o.markdown}); !ready)
        return refuse(ready.error().message);
    auto device = gpu::Device::create({});
    if (!device) return refuse(device.error().message);
    const std::string name = fmt::format("{}, {}", (*device)->info().name, (*device)->info().driver);
    std::cout << name << '\n';
    std::vector<bench::SceneCosts> all;
    for (const std::string& scene : o.scenes) {
        auto loaded = loadScene({.scene = scene, .size = o.size});
        if (!loaded) return refuse(loaded.error().message);
        ProgressLine line(scene + ": ");
        all.push_back(bench::measureChanges(**device, *loaded->asset, loaded->scene, loaded->size, settings,
                                            [&](double share) { line(share); }));
        all.back().scene = scene;
        const bench::ChangeCost& whole = all.back().of(bench::Change::kEverything);
        for (size_t i = 0; i < all.back().changes.size(); ++i) {
            const bench::ChangeCost& cost = all.back().changes[i];
            std::cout << fmt::format("{:<12} {:<36} GPU {:8.2f} ms {:5.1f} %   CPU {:8.2f} ms {:5.1f} %\n",
                                     scene, bench::changeName(bench::Change(i)), cost.gpuMs,
                                     100 * cost.gpuMs / whole.gpuMs, cost.cpuMs,
                                     100 * cost.cpuMs / whole.cpuMs);
        }
        if (o.passes) printPasses(all.back());
    }
    for (const Status& written : {writeTextFile(o.plot, bench::changesToSvg(all, name)),
                                  writeTextFile(o.markdown, bench::changesToMarkdown(all, name))})
        if (!written) return refuse(written.error().message);
    return 0;
}

}  // namespace

void addSkippingCommand(CLI::App& program, int& exitCode) {
    const auto o = std::make_shared<SkippingArguments>();
    CLI::App* command = program.add_subcommand("skipping", "what a frame costs when little changes");
    command->add_option("--scenes", o->scenes, "comma-separated")->delimiter(',')->capture_default_str();
    command->add_option("--size", o->size, "pixels, WxH")->capture_default_str();
    command->add_option("--preset", o->preset, "as render's")->capture_default_str();
    command->add_option("--plot", o->plot, "FILE.svg");
    command->add_option("--markdown", o->markdown, "FILE.md");
    command->add_flag("--passes", o->passes, "the passes that ran and what each took");
    command->callback([o, &exitCode] { exitCode = runSkipping(*o); });
}

}  // namespace ag::workbench
