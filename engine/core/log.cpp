#include "engine/core/log.h"

#include <spdlog/sinks/stdout_color_sinks.h>

namespace ag {

void initLogging(bool verbose) {
    spdlog::set_default_logger(spdlog::stderr_color_st("afterglow"));
    spdlog::set_pattern("%^%l%$: %v");
    spdlog::set_level(verbose ? spdlog::level::debug : spdlog::level::info);
}

}  // namespace ag
