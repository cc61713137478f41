// Reports on disk.
#pragma once

#include <initializer_list>
#include <string>

#include "engine/core/result.h"

namespace ag::workbench {

// Makes the folder if need be; an empty path writes nothing.
Status writeTextFile(const std::string& path, const std::string& text);
// Before the work: makes the folders of those that are not empty, and tries whether files can be made there.
Status prepareTextFiles(std::initializer_list<std::string> paths);

}  // namespace ag::workbench
