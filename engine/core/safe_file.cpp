#include "engine/core/safe_file.h"

#include <filesystem>
#include <fstream>
#include <iterator>

namespace ag {

Status writeFileSafely(const std::string& path, std::string_view text) {
    const std::string temporary = path + ".part";
    std::error_code error;
    {
        std::ofstream out(temporary, std::ios::binary);
        out << text;
        out.flush();
        if (!out) {
            std::filesystem::remove(temporary, error);
            return Error{path + ": the file cannot be written"};
        }
    }
    std::filesystem::rename(temporary, path, error);
    if (error) return Error{path + ": " + error.message()};
    return Ok{};
}

Result<std::string> readFile(const std::string& path, uint64_t mostBytes) {
    std::error_code error;
    if (std::filesystem::exists(path, error) && !std::filesystem::is_regular_file(path, error))
        return Error{path + ": it is not a file"};
    if (const uint64_t size = std::filesystem::file_size(path, error); !error && size > mostBytes)
        return Error{path + ": the file is larger than " + std::to_string(mostBytes >> 20) + " MiB"};
    std::ifstream in(path, std::ios::binary);
    if (!in) return Error{path + ": the file cannot be opened"};
    std::string text{std::istreambuf_iterator<char>(in), {}};
    if (in.bad()) return Error{path + ": the file cannot be read"};
    return text;
}

}  // namespace ag
