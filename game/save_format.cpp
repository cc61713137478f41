#include "game/save_format.h"

#include <fmt/format.h>

#include <cmath>
#include <sstream>

namespace ag::game {
namespace {

constexpr const char* kHeader = "afterglow save 1";

template <class V>
bool finite(const V& v) {
    for (int i = 0; i < V::length(); ++i)
        if (!std::isfinite(v[i])) return false;
    return true;
}

// One line; false if it is none.
bool parseLine(const std::string& line, Saved& saved) {
    std::istringstream in(line);
    std::string word, more;
    in >> word;
    bool good = false;
    if (word == "player") {
        in >> saved.feet.x >> saved.feet.y >> saved.feet.z >> saved.yaw >> saved.pitch;
        good = finite(saved.feet) && std::abs(saved.yaw) < 10 && std::abs(saved.pitch) < 2;
    } else if (word == "room") {
        SavedRoom& r = saved.rooms.emplace_back();
        in >> r.index >> r.since;
        good = r.since >= 0;
    } else if (word == "flower") {
        SavedFlower& f = saved.flowers.emplace_back();
        in >> f.node >> f.openness;
        good = f.openness >= 0 && f.openness <= 1;
    } else if (word == "body") {
        SavedBody& b = saved.bodies.emplace_back();
        in >> b.node >> b.position.x >> b.position.y >> b.position.z >> b.rotation.w >> b.rotation.x >>
            b.rotation.y >> b.rotation.z;
        good = finite(b.position) && std::abs(glm::length(b.rotation) - 1) < 1e-2f;
    }
    return good && in && !(in >> more);
}

}  // namespace

std::string saveHead(uint64_t level) {
    return fmt::format("{}\nlevel {:016x}\n", kHeader, level);
}

Result<Saved> parseSave(const std::string& text, const std::string& path, uint64_t level) {
    std::istringstream lines(text);
    std::string line;
    if (!std::getline(lines, line) || line != kHeader)
        return Error{path + ": it is not a save of this version"};
    if (!std::getline(lines, line) || line != fmt::format("level {:016x}", level))
        return Error{path + ": it was saved in another level"};
    Saved saved;
    for (int number = 3; std::getline(lines, line); ++number) {
        if (line == "end") return saved;
        if (!parseLine(line, saved)) return Error{fmt::format("{}: line {} is damaged", path, number)};
    }
    return Error{path + ": the save ends before its last line"};
}

}  // namespace ag::game
