// Files that are there whole or not at all.
#pragma once

#include <string>
#include <string_view>

#include "engine/core/result.h"

namespace ag {

// Beside the old one first, then in its place: what goes wrong leaves the old one as it was.
Status writeFileSafely(const std::string& path, std::string_view text);
Result<std::string> readFile(const std::string& path);

}  // namespace ag
