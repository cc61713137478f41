// Logging is spdlog to stderr; stdout belongs to what a command prints as its result.
#pragma once

#include <spdlog/spdlog.h>

namespace ag {

// Routes spdlog's default logger to stderr with a short pattern. Call once from main.
void initLogging(bool verbose);

}  // namespace ag
