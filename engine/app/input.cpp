#include "engine/app/input.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

#include "engine/core/safe_file.h"

namespace ag {
namespace {

constexpr const char *kHeader = "afterglow replay 3", *kHeaderWithoutNotes = "afterglow replay 2";
constexpr size_t kMostTicks = 10'000'000, kMostNotes = 32;

bool same(const Input& a, const Input& b) {
    return a.forward == b.forward && a.right == b.right && a.look == b.look && a.buttons == b.buttons;
}

bool sane(const Input& i) {
    return std::abs(i.forward) <= 1 && std::abs(i.right) <= 1 && std::abs(i.look.x) < 1e5f &&
           std::abs(i.look.y) < 1e5f && i.buttons <= kAllButtons;
}

std::string withoutBreaks(std::string text) {
    std::ranges::replace_if(
        text, [](char c) { return static_cast<unsigned char>(c) < ' '; }, ' ');
    return text;
}

std::optional<ReplayNote> parseNote(const std::string& line) {
    const size_t begin = line.find(' ') + 1, end = std::min(line.find(' ', begin), line.size());
    ReplayNote note{line.substr(begin, end - begin), end < line.size() ? line.substr(end + 1) : ""};
    const bool word = std::ranges::all_of(note.name, [](char c) { return c >= 'a' && c <= 'z'; });
    if (note.name.empty() || !word) return std::nullopt;
    return note;
}

}  // namespace

Status saveReplay(const Replay& replay, const std::string& path) {
    const std::vector<Input>& ticks = replay.ticks;
    std::string text = std::string(kHeader) + '\n';
    for (const ReplayNote& note : replay.notes)
        text += fmt::format("note {} {}\n", note.name, withoutBreaks(note.text));
    for (size_t i = 0, end = 0; i < ticks.size(); i = end) {
        for (end = i + 1; end < ticks.size() && same(ticks[i], ticks[end]);)
            ++end;
        const Input& t = ticks[i];
        text +=
            fmt::format("{} {} {} {} {} {}\n", end - i, t.forward, t.right, t.look.x, t.look.y, t.buttons);
    }
    return writeFileSafely(path, text + fmt::format("end {}\n", ticks.size()));
}

Result<Replay> loadReplay(const std::string& path) {
    const auto text = readFile(path);
    if (!text) return text.error();
    std::istringstream in(*text);
    std::string line;
    if (!std::getline(in, line) || (line != kHeader && line != kHeaderWithoutNotes))
        return Error{path + ": it is not a replay of this version"};
    Replay replay;
    std::vector<Input>& ticks = replay.ticks;
    for (size_t number = 2; std::getline(in, line); ++number) {
        size_t count = 0, total = 0;
        int used = 0;
        Input i;
        if (line.starts_with("note ") && ticks.empty()) {
            auto note = parseNote(line);
            if (!note || replay.notes.size() >= kMostNotes)
                return Error{fmt::format("{}: line {} is not a note", path, number)};
            replay.notes.push_back(std::move(*note));
            continue;
        }
        if (std::sscanf(line.c_str(), "end %zu%n", &total, &used) == 1 && size_t(used) == line.size()) {
            if (total == ticks.size()) return replay;
            return Error{
                fmt::format("{}: {} ticks are missing", path, int64_t(total) - int64_t(ticks.size()))};
        }
        if (std::sscanf(line.c_str(), "%zu %f %f %f %f %u%n", &count, &i.forward, &i.right, &i.look.x,
                        &i.look.y, &i.buttons, &used) != 6 ||
            size_t(used) != line.size())
            return Error{fmt::format("{}: line {} is not a tick", path, number)};
        if (!sane(i) || count == 0) return Error{fmt::format("{}: line {} is out of range", path, number)};
        if (count > kMostTicks - ticks.size()) return Error{path + ": the replay is longer than the limit"};
        ticks.insert(ticks.end(), count, i);
    }
    return Error{path + ": the replay ends before its last line"};
}

}  // namespace ag
