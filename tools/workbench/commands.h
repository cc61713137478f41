// The workbench's sub-commands. Each adds its options to the program and runs from its parsed values; it
// returns the process's exit code: 0 good, 1 a check failed, 2 bad arguments or input.
#pragma once

#include <CLI/CLI.hpp>

namespace ag::workbench {

void addInfoCommand(CLI::App& program, int& exitCode);
void addViewCommand(CLI::App& program, int& exitCode);
void addRenderCommand(CLI::App& program, int& exitCode);
void addReferenceCommand(CLI::App& program, int& exitCode);
void addSceneCommand(CLI::App& program, int& exitCode);
void addCaptureCommand(CLI::App& program, int& exitCode);
void addCompareCommand(CLI::App& program, int& exitCode);
void addBenchCommand(CLI::App& program, int& exitCode);
void addEcsBenchCommand(CLI::App& program, int& exitCode);
void addSkippingCommand(CLI::App& program, int& exitCode);
void addDriveCommand(CLI::App& program, int& exitCode);
void addSweepCommand(CLI::App& program, int& exitCode);
void addStressCommand(CLI::App& program, int& exitCode);

void addCompletionCommand(CLI::App& program);

// One sentence to stderr; returns 2.
int refuse(const std::string& sentence);

}  // namespace ag::workbench
