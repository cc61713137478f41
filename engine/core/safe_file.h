// Files that are there whole or not at all.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "engine/core/result.h"

namespace ag {

// Beside the old one first, then in its place: what goes wrong leaves the old one as it was.
Status writeFileSafely(const std::string& path, std::string_view text);
// Of a regular file of at most `mostBytes`.
Result<std::string> readFile(const std::string& path, uint64_t mostBytes = uint64_t(64) << 20);

}  // namespace ag
