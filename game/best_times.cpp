#include "game/best_times.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <sstream>

#include "engine/core/number.h"
#include "engine/core/safe_file.h"

namespace ag::game {
namespace {

constexpr double kLeastSeconds = 1e-3, kMostSeconds = 1e7;
constexpr double kMostRooms = 1000;

bool note(double& best, double seconds) {
    if (seconds <= 0 || (best > 0 && seconds >= best)) return false;
    best = seconds;
    return true;
}

double& roomOf(BestTimes& times, size_t index) {
    if (index >= times.rooms.size()) times.rooms.resize(index + 1);
    return times.rooms[index];
}

bool readLine(const std::string& line, BestTimes& times) {
    std::istringstream in(line);
    std::string name, first, second, more;
    in >> name >> first >> second >> more;
    if (!more.empty()) return false;
    if (name == "level" && second.empty()) {
        const char* end = first.data() + first.size();
        return std::from_chars(first.data(), end, times.level, 16).ptr == end && first.size() == 16;
    }
    if (name == "whole" && second.empty()) {
        const auto seconds = parseNumber(first, kLeastSeconds, kMostSeconds);
        if (seconds) times.whole = *seconds;
        return seconds.has_value();
    }
    const auto room = parseNumber(first, 1, kMostRooms, true),
               seconds = parseNumber(second, kLeastSeconds, kMostSeconds);
    if (name != "room" || !room || !seconds) return false;
    roomOf(times, size_t(*room) - 1) = *seconds;
    return true;
}

}  // namespace

double BestTimes::room(int32_t index) const {
    return index >= 0 && size_t(index) < rooms.size() ? rooms[size_t(index)] : 0;
}

bool BestTimes::noteRoom(int32_t index, double seconds) {
    return index >= 0 && note(roomOf(*this, size_t(index)), seconds);
}

bool BestTimes::noteWhole(double seconds) {
    return note(whole, seconds);
}

std::string clockText(double seconds) {
    const int64_t tenths = std::llround(seconds * 10);
    return fmt::format("{}:{:02}.{}", tenths / 600, tenths / 10 % 60, tenths % 10);
}

Result<BestTimes> loadBestTimes(const std::string& path) {
    const auto text = readFile(path);
    if (!text) return text.error();
    BestTimes times;
    std::istringstream lines(*text);
    std::string line;
    for (int number = 1; std::getline(lines, line); ++number)
        if (!line.empty() && line[0] != '#' && !readLine(line, times))
            return Error{fmt::format("{}: line {} is not a time", path, number)};
    return times;
}

Status saveBestTimes(const BestTimes& times, const std::string& path) {
    std::string text = fmt::format("# seconds\nlevel {:016x}\n", times.level);
    if (times.whole > 0) text += fmt::format("whole {:.3f}\n", times.whole);
    for (size_t i = 0; i < times.rooms.size(); ++i)
        if (times.rooms[i] > 0) text += fmt::format("room {} {:.3f}\n", i + 1, times.rooms[i]);
    return writeFileSafely(path, text);
}

}  // namespace ag::game
