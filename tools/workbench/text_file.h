// Reports on disk.
#pragma once

#include <string>

#include "engine/core/result.h"

namespace ag::workbench {

// Makes the folder if need be; an empty path writes nothing.
Status writeTextFile(const std::string& path, const std::string& text);

}  // namespace ag::workbench
