#include <fmt/format.h>

#include <iostream>

#include "engine/core/number_option.h"
#include "tools/bench/spot_sweep.h"
#include "tools/workbench/commands.h"
#include "tools/workbench/progress_line.h"
#include "tools/workbench/text_file.h"

namespace ag::workbench {
namespace {

struct SweepArguments {
    bench::SweepOptions sweep;
    std::string csv, plot;
};

int runSweep(const SweepArguments& o) {
    if (const Status ready = prepareTextFiles({o.csv, o.plot}); !ready) return refuse(ready.error().message);
    auto device = gpu::Device::create({});
    if (!device) return refuse(device.error().message);
    std::cout << (*device)->info().name << '\n';
    ProgressLine line("sweep: ");
    const auto frames = bench::sweepSpot(**device, o.sweep, [&](double share) { line(share); });
    for (size_t v = 0; v < bench::kSweepVariants.size(); ++v) {
        double spread = 0, error = 0;
        for (const bench::SweepFrame& f : frames)
            spread += f.spread[v] / double(frames.size()), error += f.error[v] / double(frames.size());
        std::cout << fmt::format("{:<26} mean spread of areas {:.3f}, mean relative RMSE {:.4f}\n",
                                 bench::kSweepVariants[v], spread, error);
    }
    for (const Status& written :
         {writeTextFile(o.csv, sweepToCsv(frames)), writeTextFile(o.plot, sweepToSvg(frames))})
        if (!written) return refuse(written.error().message);
    return 0;
}

}  // namespace

void addSweepCommand(CLI::App& program, int& exitCode) {
    const auto o = std::make_shared<SweepArguments>();
    CLI::App* command = program.add_subcommand("sweep", "clusters while a spot sweeps from wall to wall");
    command->add_option("--frames", o->sweep.frames, "of the ten seconds")
        ->check(numberFrom(2, 100000))
        ->capture_default_str();
    command->add_option("--every", o->sweep.every, "frames between two that are measured")
        ->check(numberFrom(1, 100000))
        ->capture_default_str();
    command->add_option("--clusters", o->sweep.clusters, "")
        ->check(numberFrom(16, 1024))
        ->capture_default_str();
    command->add_option("--csv", o->csv, "FILE");
    command->add_option("--plot", o->plot, "FILE.svg");
    command->callback([o, &exitCode] { exitCode = runSweep(*o); });
}

}  // namespace ag::workbench
