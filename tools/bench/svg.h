// The few pieces of SVG that charts share.
#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>

namespace ag::bench {

// A white page; ends with "</svg>".
inline std::string svgBegin(double width, double height) {
    return fmt::format(
        "<svg xmlns='http://www.w3.org/2000/svg' width='{0:.0f}' height='{1:.0f}' viewBox='0 0 {0:.0f} "
        "{1:.0f}' font-family='sans-serif'>\n<rect width='100%' height='100%' fill='#fff'/>\n",
        width, height);
}

inline std::string svgText(double x, double y, std::string_view anchor, double size, std::string_view words,
                           std::string_view color = "#333") {
    return fmt::format("<text x='{:.1f}' y='{:.1f}' text-anchor='{}' font-size='{}' fill='{}'>{}</text>\n", x,
                       y, anchor, size, color, words);
}

}  // namespace ag::bench
