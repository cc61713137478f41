#include "tools/workbench/text_file.h"

#include "engine/core/safe_file.h"

namespace ag::workbench {

Status writeTextFile(const std::string& path, const std::string& text) {
    if (path.empty()) return Ok{};
    if (const Status made = makeFolderOf(path); !made) return made;
    return writeFileSafely(path, text);
}

Status prepareTextFiles(std::initializer_list<std::string> paths) {
    for (const std::string& path : paths) {
        if (path.empty()) continue;
        if (const Status made = makeFolderOf(path); !made) return made;
        if (const Status writable = checkWritable(path); !writable) return writable;
    }
    return Ok{};
}

}  // namespace ag::workbench
