// Small helpers for sentences.
#pragma once

#include <string>
#include <string_view>

namespace ag {

// What a library says may be many lines; a fault is one. `otherwise`: where it says nothing.
inline std::string firstLine(std::string_view text, std::string_view otherwise) {
    const std::string_view line = text.substr(0, text.find('\n'));
    return std::string(line.empty() ? otherwise : line);
}

}  // namespace ag
