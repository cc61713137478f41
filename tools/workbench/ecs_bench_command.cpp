#include "tools/ecs_bench/ecs_bench.h"
#include "tools/workbench/commands.h"

namespace ag::workbench {

void addEcsBenchCommand(CLI::App& program, int& exitCode) {
    CLI::App* command = program.add_subcommand(
        "ecs-bench", "the ECS beside plain arrays; takes Google Benchmark's flags (--benchmark_filter=…)");
    command->prefix_command();
    command->callback([&exitCode, command] {
        std::vector<std::string> flags = command->remaining();
        std::vector<char*> arguments;
        std::string name = "afterglow ecs-bench";
        arguments.push_back(name.data());
        for (std::string& flag : flags)
            arguments.push_back(flag.data());
        exitCode = ecs_bench::run(int(arguments.size()), arguments.data());
    });
}

}  // namespace ag::workbench
