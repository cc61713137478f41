#include "game/replay_notes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "game/quality.h"
#include "game/save_game.h"

namespace ag::game {
namespace {

constexpr const char *kLevelNote = "level", *kWorldNote = "world";

const std::string* noteOf(const ReplayNotes& notes, std::string_view name) {
    const auto found = std::ranges::find(notes, name, &ReplayNote::name);
    return found == notes.end() ? nullptr : &found->text;
}

std::string qualityOf(const Demo& demo) {
    std::string text(qualityName(demo.user.quality));
    for (const std::string& assignment : demo.options.assignments)
        text += " " + assignment;
    return text;
}

std::string frameOf(const Demo& demo) {
    return demo.options.headless ? fmt::format("{} ticks", demo.options.ticksPerFrame)
                                 : "as many ticks as the clock asked for";
}

}  // namespace

ReplayNotes replayNotes(const Demo& demo) {
    return {
        {"version", AFTERGLOW_VERSION}, {kLevelNote, fmt::format("{:016x}", levelHash(demo.game->level()))},
        {"device", demo.device},        {"quality", qualityOf(demo)},
        {"frame", frameOf(demo)},       {kWorldNote, fmt::format("{:016x}", demo.game->stateHash())}};
}

Status checkReplay(const Demo& demo) {
    const std::string* level = noteOf(demo.replay.notes, kLevelNote);
    if (level && *level != *noteOf(replayNotes(demo), kLevelNote))
        return Error{demo.options.replay + ": it was recorded in another level"};
    return Ok{};
}

std::string replayVerdict(const Demo& demo) {
    const ReplayNotes now = replayNotes(demo);
    const std::string* world = noteOf(demo.replay.notes, kWorldNote);
    if (!world) return "";
    if (*world == *noteOf(now, kWorldNote)) return "the world is the recording's\n";
    std::vector<std::string> differences;
    for (const ReplayNote& here : now)
        if (const std::string* there = noteOf(demo.replay.notes, here.name);
            there && *there != here.text && here.name != kWorldNote)
            differences.push_back(fmt::format("{} {}, here {}", here.name, *there, here.text));
    return fmt::format("the world is not the recording's; it was made with {}\n",
                       differences.empty() ? "all that is noted of it the same; a quality chosen "
                                             "as it goes, or a later program of this version, may be why"
                                           : fmt::format("{}", fmt::join(differences, "; ")));
}

}  // namespace ag::game
