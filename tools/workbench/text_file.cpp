#include "tools/workbench/text_file.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>

namespace ag::workbench {

Status writeTextFile(const std::string& path, const std::string& text) {
    if (path.empty()) return Ok{};
    std::error_code ignored;
    std::filesystem::create_directories(std::filesystem::path(path).parent_path(), ignored);
    std::ofstream out(path, std::ios::binary);
    out << text;
    out.flush();
    if (!out) return Error{fmt::format("cannot write {}", path)};
    return Ok{};
}

}  // namespace ag::workbench
