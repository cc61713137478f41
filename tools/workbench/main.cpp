// The workbench: one program, sub-commands to look at scenes, devices, images and times.
#include <iostream>

#include "engine/core/log.h"
#include "tools/workbench/commands.h"

namespace ag::workbench {

int refuse(const std::string& sentence) {
    std::cerr << "afterglow: " << sentence << '\n';
    return 2;
}

}  // namespace ag::workbench

int main(int argc, char** argv) {
    ag::initLogging(false);
    CLI::App program("Afterglow workbench: real-time indirect light, measured", "afterglow");
    program.require_subcommand(1);
    int exitCode = 0;
    ag::workbench::addInfoCommand(program, exitCode);
    ag::workbench::addRenderCommand(program, exitCode);
    ag::workbench::addReferenceCommand(program, exitCode);
    ag::workbench::addSceneCommand(program, exitCode);
    ag::workbench::addCompareCommand(program, exitCode);
    ag::workbench::addBenchCommand(program, exitCode);
    ag::workbench::addCaptureCommand(program, exitCode);
    ag::workbench::addEcsBenchCommand(program, exitCode);
    ag::workbench::addSkippingCommand(program, exitCode);
    ag::workbench::addSweepCommand(program, exitCode);
    ag::workbench::addStressCommand(program, exitCode);
    try {
        program.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) return program.exit(error);  // --help
        return ag::workbench::refuse(error.what());
    }
    return exitCode;
}
