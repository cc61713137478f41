#include "tools/bench/row_cache.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "engine/core/hash.h"
#include "engine/core/log.h"
#include "engine/core/safe_file.h"

namespace ag::bench {
namespace {

namespace fs = std::filesystem;

constexpr uint64_t kMostProgramBytes = uint64_t(1) << 30;

uint64_t hashFile(const std::string& path, uint64_t hash) {
    const auto bytes = readFile(path, kMostProgramBytes);
    return bytes ? hashBytes(std::as_bytes(std::span(*bytes)), hash) : hash;
}

}  // namespace

RowCache::RowCache(std::string folder) : folder_(std::move(folder)) {}

std::string RowCache::pathOf(uint64_t key) const {
    return (fs::path(folder_) / fmt::format("row-{:016x}.json", key)).string();
}

std::optional<std::vector<Row>> RowCache::find(uint64_t key) const {
    if (folder_.empty()) return std::nullopt;
    const auto text = readFile(pathOf(key));
    if (!text) return std::nullopt;
    const nlohmann::json parsed = nlohmann::json::parse(*text, nullptr, false);
    if (!parsed.is_array()) return std::nullopt;  // another program's, or damaged: measured anew
    std::vector<Row> rows;
    for (const nlohmann::json& json : parsed) {
        auto row = rowFromJson(json);
        if (!row) return std::nullopt;
        rows.push_back(std::move(*row));
    }
    if (rows.empty()) return std::nullopt;
    return rows;
}

void RowCache::keep(uint64_t key, const std::vector<Row>& rows) const {
    if (folder_.empty()) return;
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    for (const Row& row : rows)
        json.push_back(rowToJson(row));
    const std::string path = pathOf(key);
    const Status made = makeFolderOf(path);
    if (const Status kept = made ? writeFileSafely(path, json.dump() + "\n") : made; !kept)
        spdlog::warn("the row is not kept: {}", kept.error().message);
}

uint64_t RowCache::programHash() {
    std::vector<std::string> shaders;
    std::error_code error;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(AFTERGLOW_SHADER_DIR, error))
        if (entry.path().extension() == ".spv") shaders.push_back(entry.path().string());
    std::ranges::sort(shaders);
    uint64_t hash = hashFile("/proc/self/exe", 0);
    for (const std::string& shader : shaders)
        hash = hashFile(shader, hash);
    return hash;
}

}  // namespace ag::bench
