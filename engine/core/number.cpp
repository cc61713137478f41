#include "engine/core/number.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

namespace ag {

std::optional<double> parseNumber(std::string_view text) {
    if (text.starts_with('+')) text.remove_prefix(1);
    double value = 0;
    const char* end = text.data() + text.size();
    const auto [last, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc() || last != end || !std::isfinite(value)) return std::nullopt;
    return value;
}

std::optional<double> parseNumber(std::string_view text, double least, double most, bool whole) {
    const std::optional<double> value = parseNumber(text);
    const bool fits = value && *value >= least && *value <= most && (!whole || *value == std::floor(*value));
    return fits ? value : std::nullopt;
}

std::string numberFault(std::string_view text, double least, double most, bool whole) {
    if (parseNumber(text, least, most, whole)) return "";
    return fmt::format("'{}' is not a {}number from {:g} to {:g}", text, whole ? "whole " : "", least, most);
}

Result<glm::uvec2> parseSize(std::string_view text) {
    constexpr double kMostPixels = 8192;  // a side
    const size_t cross = text.find('x');
    const auto width = parseNumber(text.substr(0, cross), 1, kMostPixels, true);
    const auto height = cross == std::string_view::npos
                            ? std::nullopt
                            : parseNumber(text.substr(cross + 1), 1, kMostPixels, true);
    if (!width || !height)
        return Error{fmt::format("a size is WxH with 1 to 8192 pixels a side, not '{}'", text)};
    return glm::uvec2(*width, *height);
}

}  // namespace ag
