#include "game/user_files.h"

#include <fmt/format.h>

#include <filesystem>
#include <sstream>

#include "engine/core/number.h"
#include "engine/core/safe_file.h"

namespace ag::game {
namespace {

struct Number {
    const char* name;
    float UserSettings::*value;
    float least, most;
};
constexpr Number kNumbers[] = {{"sensitivity", &UserSettings::sensitivity, 0.1f, 5},
                               {"field_of_view", &UserSettings::fieldOfView, 40, 100},
                               {"exposure", &UserSettings::exposure, -4, 6},
                               {"volume", &UserSettings::volume, 0, 1},
                               {"resolution", &UserSettings::resolution, 0, 1},
                               {"rooms_reached", &UserSettings::roomsReached, 0, 1000}};
struct Flag {
    const char* name;
    bool UserSettings::*value;
};
constexpr Flag kFlags[] = {{"hints", &UserSettings::hints},
                           {"subtitles", &UserSettings::subtitles},
                           {"invert_look", &UserSettings::invertLook},
                           {"fullscreen", &UserSettings::fullscreen}};

bool readLine(const std::string& line, UserSettings& s) {
    std::istringstream in(line);
    std::string name, value, more;
    if (!(in >> name >> value) || in >> more) return false;
    if (name == "quality") {
        const auto quality = qualityFromName(value);
        if (quality) s.quality = *quality;
        return quality.has_value();
    }
    for (const Flag& f : kFlags)
        if (name == f.name) {
            s.*f.value = value == "on";
            return value == "on" || value == "off";
        }
    for (const Number& n : kNumbers)
        if (name == n.name) {
            const auto number = parseNumber(value, double(n.least), double(n.most));
            if (number) s.*n.value = float(*number);
            return number.has_value();
        }
    return false;
}

}  // namespace

Status openFolder(const UserFiles& files) {
    std::error_code error;
    std::filesystem::create_directories(files.folder, error);
    if (error) return Error{fmt::format("{}: {}", files.folder, error.message())};
    return Ok{};
}

Result<UserSettings> loadUserSettings(const std::string& path) {
    const auto text = readFile(path);
    if (!text) return text.error();
    UserSettings settings;
    std::istringstream lines(*text);
    std::string line;
    for (int number = 1; std::getline(lines, line); ++number)
        if (!line.empty() && line[0] != '#' && !readLine(line, settings))
            return Error{fmt::format("{}: line {} is not a setting", path, number)};
    return settings;
}

Status saveUserSettings(const UserSettings& s, const std::string& path) {
    std::string text = fmt::format("quality {}\n", qualityName(s.quality));
    for (const Number& n : kNumbers)
        text += fmt::format("{} {}\n", n.name, s.*n.value);
    for (const Flag& f : kFlags)
        text += fmt::format("{} {}\n", f.name, s.*f.value ? "on" : "off");
    return writeFileSafely(path, text);
}

}  // namespace ag::game
