#include "engine/core/near_name.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

namespace ag {
namespace {

// Optimal string alignment distance (Damerau 1964): neighbours swapped count once.
size_t letterDistance(std::string_view a, std::string_view b) {
    std::vector<std::vector<size_t>> d(a.size() + 1, std::vector<size_t>(b.size() + 1));
    for (size_t i = 0; i <= a.size(); ++i)
        for (size_t j = 0; j <= b.size(); ++j) {
            if (i == 0 || j == 0) {
                d[i][j] = i + j;
                continue;
            }
            d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + (a[i - 1] != b[j - 1])});
            const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
            if (swapped) d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
        }
    return d[a.size()][b.size()];
}

}  // namespace

std::string_view nearestName(std::string_view name, std::span<const std::string_view> known) {
    constexpr size_t kLongest = 100;  // letters: nobody mistypes more
    if (known.empty() || name.size() > kLongest) return {};
    const auto nearest =
        std::ranges::min_element(known, {}, [&](std::string_view k) { return letterDistance(name, k); });
    const size_t allowed = std::max<size_t>(1, std::max(name.size(), nearest->size()) / 3);
    return letterDistance(name, *nearest) <= allowed ? *nearest : std::string_view();
}

std::string missingName(std::string_view kind, std::string_view name,
                        std::span<const std::string_view> known) {
    const std::string_view near = nearestName(name, known);
    return fmt::format("there is no {} '{}'{} (there are: {})", kind, name,
                       near.empty() ? "" : fmt::format("; did you mean '{}'?", near), fmt::join(known, ", "));
}

}  // namespace ag
