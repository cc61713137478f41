#include <fmt/format.h>

#include <iostream>

#include "engine/core/number_option.h"
#include "tools/stress/stress.h"
#include "tools/workbench/commands.h"

namespace ag::workbench {
namespace {

struct Options {
    stress::StressOptions stress;
    bool quick = false;
    bool validate = false;
};

std::string line(const stress::StressRow& row) {
    const std::string more = row.fault ? "  " + *row.fault : row.note.empty() ? "" : "  " + row.note;
    return fmt::format("{:<4} {:<44} {:>10.3g} <= {:<8g} {}{}\n", row.good() ? "good" : "BAD", row.name,
                       row.value, row.limit, row.measure, more);
}

int runStress(Options options) {
    if (options.quick) {
        options.stress.scenes = {"cornell"};
        options.stress.frames = 12;
        options.stress.movingFrames = 96;
        options.stress.mapResolution = 128;
        options.stress.twice = false;
    }
    if (options.validate) options.stress.mostGrowth = 64;  // the layers' own records grow for long
    auto device = gpu::Device::create({.validation = options.validate});
    if (!device) return refuse(device.error().message);
    std::cout << "device " << (*device)->info().name << '\n';
    uint32_t rows = 0, bad = 0;
    stress::runStress(**device, options.stress, [&](const stress::StressRow& row) {
        ++rows;
        bad += !row.good();
        std::cout << line(row) << std::flush;
    });
    if (rows == 0) return refuse(fmt::format("no case is named like '{}'", options.stress.only));
    const int messages = (*device)->validationMessageCount();
    std::cout << fmt::format("{} of {} good{}\n", rows - bad, rows,
                             options.validate ? fmt::format(", {} validation messages", messages) : "");
    return bad == 0 && messages == 0 ? 0 : 1;
}

}  // namespace

void addStressCommand(CLI::App& program, int& exitCode) {
    const auto o = std::make_shared<Options>();
    CLI::App* command =
        program.add_subcommand("stress", "hard cases of scale, place, power, shape and change, a line each");
    command->add_flag("--quick", o->quick, "one scene, fewer frames, each case once");
    command->add_option("--only", o->stress.only, "cases whose name holds this text");
    command->add_option("--frames", o->stress.movingFrames, "of random motion")
        ->check(numberFrom(1, 1e7))
        ->capture_default_str();
    command->add_flag("--validate", o->validate, "with Vulkan validation; any message exits with 1");
    command->callback([o, &exitCode] { exitCode = runStress(*o); });
}

}  // namespace ag::workbench
