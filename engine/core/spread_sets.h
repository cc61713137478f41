// The command line as the parser takes it.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace ag {

// A program's arguments without its name, "--set a.x=1 b.y=2" as "--set a.x=1 --set b.y=2". Last first, as
// CLI11 takes them.
std::vector<std::string> reversedArguments(std::span<char* const> argv);

}  // namespace ag
