// The workbench: one program, sub-commands to look at scenes, devices, images and times.
#include <algorithm>
#include <iostream>

#include "engine/core/near_name.h"
#include "engine/core/program.h"
#include "engine/core/spread_sets.h"
#include "tools/workbench/commands.h"

namespace ag::workbench {
namespace {

// The sentence for a first word that is no sub-command; empty where it is one, or an option.
std::string wrongCommand(const CLI::App& program, std::string_view word) {
    std::vector<std::string> names;
    for (const CLI::App* command : program.get_subcommands({}))
        names.push_back(command->get_name());
    if (word.starts_with('-') || std::ranges::find(names, word) != names.end()) return "";
    return missingName("sub-command", word, std::vector<std::string_view>(names.begin(), names.end()));
}

int run(int argc, char** argv) {
    CLI::App program("Afterglow workbench: real-time indirect light, measured", "afterglow");
    program.require_subcommand(1);
    int exitCode = 0;
    addInfoCommand(program, exitCode);
    addViewCommand(program, exitCode);
    addRenderCommand(program, exitCode);
    addReferenceCommand(program, exitCode);
    addSceneCommand(program, exitCode);
    addCompareCommand(program, exitCode);
    addBenchCommand(program, exitCode);
    addCaptureCommand(program, exitCode);
    addEcsBenchCommand(program, exitCode);
    addSkippingCommand(program, exitCode);
    addDriveCommand(program, exitCode);
    addSweepCommand(program, exitCode);
    addStressCommand(program, exitCode);
    addCompletionCommand(program);
    if (const std::string wrong = argc > 1 ? wrongCommand(program, argv[1]) : ""; !wrong.empty())
        return refuse(wrong);
    try {
        program.parse(reversedArguments({argv, size_t(argc)}));
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
