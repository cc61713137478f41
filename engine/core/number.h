// Numbers that come from outside: command lines, settings, files. Each is finite and in its range, or
// refused.
#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "engine/core/result.h"

namespace ag {

// The whole text as a decimal number; nothing for other text, for infinities and for what is not a number.
std::optional<double> parseNumber(std::string_view text);
// The same within a range; `whole`: without a fraction.
std::optional<double> parseNumber(std::string_view text, double least, double most, bool whole = false);
// What is wrong with it, in one sentence; empty: nothing.
std::string numberFault(std::string_view text, double least, double most, bool whole = false);
// "WxH" pixels, 1 to 8192 a side.
Result<glm::uvec2> parseSize(std::string_view text);

}  // namespace ag
