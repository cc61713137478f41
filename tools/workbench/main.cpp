// The workbench: one program, sub-commands to look at scenes, devices, images and times.
#include <iostream>

#include "engine/core/program.h"
#include "tools/workbench/commands.h"

namespace ag::workbench {
namespace {

int run(int argc, char** argv) {
    CLI::App program("Afterglow workbench: real-time indirect light, measured", "afterglow");
    program.require_subcommand(1);
    int exitCode = 0;
    addInfoCommand(program, exitCode);
    addRenderCommand(program, exitCode);
    addReferenceCommand(program, exitCode);
    addSceneCommand(program, exitCode);
    addCompareCommand(program, exitCode);
    addBenchCommand(program, exitCode);
    addCaptureCommand(program, exitCode);
    addEcsBenchCommand(program, exitCode);
    addSkippingCommand(program, exitCode);
    addSweepCommand(program, exitCode);
    addStressCommand(program, exitCode);
    try {
        program.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) return program.exit(error);  // --help
        return refuse(error.what());
    }
    return exitCode;
}

}  // namespace

int refuse(const std::string& sentence) {
    std::cerr << "afterglow: " << sentence << '\n';
    return kExitRefused;
}

}  // namespace ag::workbench

int main(int argc, char** argv) {
    return ag::runProgram([&] { return ag::workbench::run(argc, argv); });
}
