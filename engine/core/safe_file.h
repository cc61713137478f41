// All files of ours are read and written here: what is written is there whole or not at all, what is read is
// a regular file of bounded size.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "engine/core/result.h"

namespace ag {

// Writes a file of a unique name beside `path`, syncs it to the disk, renames it to `path`. A fault at any
// step, a kill or a full disk leaves an existing file as it was. Follows links; keeps an existing file's
// permissions. Pipes and devices (/dev/stdout) are written directly.
Status writeFileSafely(const std::string& path, std::string_view bytes);
// Whether a file could be made there now, so that an output is refused before the work. Leaves nothing
// behind.
Status checkWritable(const std::string& path);
// The same for several; an empty path is none.
Status checkWritable(std::initializer_list<std::string_view> paths);
// Makes the folder in which a file is to lie, if it is not there.
Status makeFolderOf(const std::string& path);

constexpr uint64_t kMostFileBytes = uint64_t(64) << 20;
// Fails for what is no regular file (a folder, a pipe, a device) without reading or waiting, and for more
// than `mostBytes`.
Result<std::string> readFile(const std::string& path, uint64_t mostBytes = kMostFileBytes);

bool fileExists(const std::string& path);

// Where a user's own files lie: $XDG_CONFIG_HOME/afterglow, or ~/.config/afterglow.
std::string userFolder();

}  // namespace ag
