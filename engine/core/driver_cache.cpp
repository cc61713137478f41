#include "engine/core/driver_cache.h"

#include <cstdlib>
#include <string>

namespace ag {
namespace {

constexpr const char* kMesaFolder = "MESA_SHADER_CACHE_DIR";

std::filesystem::path fromEnvironment(const char* name) {
    const char* value = std::getenv(name);
    return value ? value : "";
}

// Text of the environment as the name of a folder.
std::string asFolderName(const char* text) {
    std::string name = text;
    for (char& c : name)
        if (c == '/') c = '_';
    return name;
}

bool pointMesaAway() {
    const char* width = std::getenv("LP_NATIVE_VECTOR_WIDTH");
    const std::string name = "lanes-" + (width ? asFolderName(width) : "native");
    std::filesystem::path parent = fromEnvironment(kMesaFolder);
    if (parent.filename() == name) return true;  // by a program of ours that started this one
    if (parent.empty()) parent = cacheFolder();
    if (parent.empty()) return true;  // nor does Mesa find a place, and goes without
    // Mesa makes the last folder only. One that cannot be made leaves it without a cache.
    std::error_code ignored;
    std::filesystem::create_directories(parent, ignored);
    ::setenv(kMesaFolder, (parent / name).c_str(), 1);
    return true;
}

}  // namespace

std::filesystem::path cacheFolder() {
    if (const auto own = fromEnvironment("AFTERGLOW_CACHE_DIR"); !own.empty()) return own;
    if (const auto user = fromEnvironment("XDG_CACHE_HOME"); !user.empty()) return user / "afterglow";
    if (const auto home = fromEnvironment("HOME"); !home.empty()) return home / ".cache/afterglow";
    return {};
}

void separateDriverCaches() {
    [[maybe_unused]] static const bool done = pointMesaAway();
}

}  // namespace ag
