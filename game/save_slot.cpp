#include "game/save_slot.h"

#include "engine/core/log.h"
#include "engine/core/safe_file.h"
#include "game/save_game.h"

namespace ag::game {

bool SaveSlot::exists() const {
    return fileExists(path_);
}

bool SaveSlot::putBrokenAside(const Game& game) {
    if (checked_ || !exists()) return true;
    checked_ = true;
    const Status moved = putBrokenSaveAside(game, path_);
    if (!moved) spdlog::warn("{}", moved.error().message);
    return bool(moved);
}

Status SaveSlot::makeRoomForNewGame(const Game& game) {
    return putBrokenAside(game) && exists() ? putSaveAside(path_, ".before") : Status(Ok{});
}

bool SaveSlot::save(Game& game) {
    if (!putBrokenAside(game)) return false;
    const Status saved = saveGame(game, path_);
    if (!saved) spdlog::warn("{}", saved.error().message);
    return bool(saved);
}

}  // namespace ag::game
