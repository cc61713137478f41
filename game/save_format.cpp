#include "game/save_format.h"

#include <fmt/format.h>

#include <cmath>
#include <sstream>

namespace ag::game {
namespace {

constexpr const char* kHeader = "afterglow save 1";

bool inside(const glm::dvec3& place, const SaveLimits& limits) {
    return glm::all(glm::greaterThanEqual(place, limits.least)) &&
           glm::all(glm::lessThanEqual(place, limits.most));
}

// One line; false if it is none.
bool parseLine(const std::string& line, const SaveLimits& limits, Saved& saved) {
    constexpr float kMostSeconds = 1e9f;
    std::istringstream in(line);
    std::string word, more;
    in >> word;
    bool good = false;
    if (word == "player") {
        in >> saved.feet.x >> saved.feet.y >> saved.feet.z >> saved.yaw >> saved.pitch;
        good = inside(saved.feet, limits) && std::abs(saved.yaw) < 10 && std::abs(saved.pitch) < 2;
    } else if (word == "room") {
        SavedRoom& r = saved.rooms.emplace_back();
        in >> r.index >> r.since;
        good = r.index >= 0 && r.index <= limits.mostRoom && r.since >= 0 && r.since < kMostSeconds;
    } else if (word == "flower") {
        SavedFlower& f = saved.flowers.emplace_back();
        in >> f.node >> f.openness;
        good = f.node < limits.nodes && f.openness >= 0 && f.openness <= 1;
    } else if (word == "played") {
        in >> saved.played;
        good = saved.played >= -1 && saved.played < double(kMostSeconds);
        saved.timed = true;
    } else if (word == "won") {
        good = saved.won = true;
    } else if (word == "spent") {
        SavedTime& t = saved.times.emplace_back();
        in >> t.room >> t.seconds;
        good = t.room >= 0 && t.room <= limits.mostRoom && t.seconds >= 0 && t.seconds < double(kMostSeconds);
    } else if (word == "body") {
        SavedBody& b = saved.bodies.emplace_back();
        in >> b.node >> b.position.x >> b.position.y >> b.position.z >> b.rotation.w >> b.rotation.x >>
            b.rotation.y >> b.rotation.z;
        good = b.node < limits.nodes && inside(b.position, limits) &&
               std::abs(glm::length(b.rotation) - 1) < 1e-2f;
    }
    return good && in && !(in >> more);
}

}  // namespace

std::string saveHead(uint64_t level) {
    return fmt::format("{}\nlevel {:016x}\n", kHeader, level);
}

Result<Saved> parseSave(const std::string& text, const std::string& path, const SaveLimits& limits) {
    std::istringstream lines(text);
    std::string line;
    if (!std::getline(lines, line) || line != kHeader)
        return Error{path + ": it is not a save of this version"};
    if (!std::getline(lines, line) || line != fmt::format("level {:016x}", limits.level))
        return Error{path + ": it was saved in another level"};
    Saved saved;
    for (int number = 3; std::getline(lines, line); ++number) {
        if (line == "end") {
            if (!std::getline(lines, line)) return saved;
            return Error{fmt::format("{}: line {} stands after the end", path, number + 1)};
        }
        if (!parseLine(line, limits, saved))
            return Error{fmt::format("{}: line {} is damaged", path, number)};
    }
    return Error{path + ": the save ends before its last line"};
}

}  // namespace ag::game
