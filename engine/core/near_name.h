// Names that nobody knows, and what was probably meant.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace ag {

// The known name with the fewest letters to insert, drop, change or swap; empty where none is near: not more
// than a third of the letters.
std::string_view nearestName(std::string_view name, std::span<const std::string_view> known);

// "there is no preset 'higj'; did you mean 'high'? (there are: low, high)"
std::string missingName(std::string_view kind, std::string_view name,
                        std::span<const std::string_view> known);

}  // namespace ag
