// The ECS measured beside plain structure-of-arrays loops in the same run, against docs/ecs.md's targets.
#pragma once

namespace ag::ecs_bench {

// Takes Google Benchmark's flags. Prints every benchmark, then a table of rows; 0 if every row holds, 1 if
// one does not, 2 for a flag nobody knows.
int run(int argc, char** argv);

}  // namespace ag::ecs_bench
