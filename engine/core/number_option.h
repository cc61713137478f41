// The check of a number on a command line, for CLI11's options.
#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "engine/core/number.h"

namespace ag {

// Finite and within the range; the help shows it.
inline CLI::Validator numberFrom(double least, double most) {
    const auto check = [least, most](std::string& text) { return numberFault(text, least, most); };
    return CLI::Validator(check, fmt::format("{:g}..{:g}", least, most));
}

}  // namespace ag
