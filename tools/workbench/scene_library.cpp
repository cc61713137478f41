#include "tools/workbench/scene_library.h"

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "engine/core/number.h"
#include "engine/core/safe_file.h"

namespace ag::workbench {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

// AFTERGLOW_SCENES names the folder; without it, shared/scenes beside the repository.
fs::path libraryFolder() {
    const char* named = std::getenv("AFTERGLOW_SCENES");
    return named ? fs::path(named) : fs::path(AFTERGLOW_SOURCE_DIR) / "../shared/scenes";
}

std::string triple(const json& v) {
    return fmt::format("{},{},{}", v.at(0).get<double>(), v.at(1).get<double>(), v.at(2).get<double>());
}

}  // namespace

Result<std::optional<LibraryScene>> findInLibrary(const std::string& name) {
    const std::optional<LibraryScene> none;
    const size_t colon = name.find(':');
    const std::string folder = name.substr(0, colon);
    const fs::path list = libraryFolder() / "scenes.json";
    const auto text = readFile(list.string());
    if (!text) return none;
    try {
        const json listed = json::parse(*text);
        for (const json& scene : listed.at("scenes")) {
            const fs::path file = scene.at("file").get<std::string>();
            if (file.begin()->string() != folder) continue;
            LibraryScene found{.file = (libraryFolder() / file).lexically_normal().string()};
            if (scene.contains("sun_direction") && !scene["sun_direction"].is_null())
                found.sun = triple(scene["sun_direction"]) + ",10";
            const json views = scene.value("views", json::array());
            const std::string number = colon == std::string::npos ? "0" : name.substr(colon + 1);
            const auto view = parseNumber(number, 0, std::max(double(views.size()) - 1, 0.0), true);
            if (!view)
                return Error{fmt::format("scene {} has {} views, from 0 on, and no view '{}'", folder,
                                         views.size(), number)};
            if (!views.empty()) {
                const json& chosen = views[size_t(*view)];
                found.view = triple(chosen.at("position")) + "," + triple(chosen.at("target"));
            }
            return std::optional(found);
        }
    } catch (const json::exception& e) {
        return Error{fmt::format("{} cannot be read: {}", list.string(), e.what())};
    }
    return none;
}

}  // namespace ag::workbench
