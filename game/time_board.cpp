#include "game/time_board.h"

#include <fmt/format.h>

#include "engine/core/log.h"
#include "engine/core/safe_file.h"
#include "game/save_game.h"

namespace ag::game {
namespace {

template <class F>
void eachSolved(Game& game, F f) {
    View<const Room>(game.world(), {}).each([&](const Room& room) {
        if (room.solved) f(room.index);
    });
}

}  // namespace

Status TimeBoard::open(const Game& game) {
    best_ = {.level = levelHash(game.level())};
    if (!fileExists(path_)) return Ok{};
    const auto known = loadBestTimes(path_);
    if (known && known->level == best_.level) {
        best_ = *known;
        return Ok{};
    }
    const std::string why = known ? path_ + ": its times are of another level" : known.error().message;
    if (const Status moved = putSaveAside(path_, ".before"); !moved) return moved;
    return Error{why + "; it is kept as " + path_ + ".before"};
}

void TimeBoard::startOver(Game& game) {
    solved_.clear();
    eachSolved(game, [&](int32_t room) { solved_.insert(room); });
    won_ = game.progress().won != 0;
}

std::string TimeBoard::tell(const char* what, double seconds, double before, bool better) {
    if (better)
        if (const Status saved = saveBestTimes(best_, path_); !saved)
            spdlog::warn("{}", saved.error().message);
    std::string text = fmt::format("{} in {}", what, clockText(seconds));
    if (before > 0)
        text += better ? fmt::format(": before it was {}", clockText(before))
                       : fmt::format("; at best {}", clockText(before));
    return text;
}

std::string TimeBoard::follow(Game& game) {
    const PlayTime& played = game.world().resource<PlayTime>();
    std::string news;
    eachSolved(game, [&](int32_t room) {
        if (!solved_.insert(room).second) return;
        const double seconds = size_t(room) < played.rooms.size() ? played.rooms[size_t(room)] : 0;
        if (seconds <= 0) return;
        const double before = best_.room(room);
        const bool better = best_.noteRoom(room, seconds);
        news = tell(fmt::format("Room {}", room + 1).c_str(), seconds, before, better);
    });
    const bool won = game.progress().won != 0;
    if (won && !won_ && played.known) {
        const double before = best_.whole;
        const bool better = best_.noteWhole(played.whole);
        news = tell("The whole gallery", played.whole, before, better);
    }
    won_ = won;
    return news;
}

std::vector<std::string> TimeBoard::roomNotes() const {
    std::vector<std::string> notes;
    for (const double seconds : best_.rooms)
        notes.push_back(seconds > 0 ? "at best " + clockText(seconds) : "");
    return notes;
}

}  // namespace ag::game
