// A game put by and gone on with: where the player stands, what is open, where things lie. Text, checked in
// whole before anything of it counts.
#pragma once

#include <string>

#include "engine/core/result.h"
#include "game/game.h"

namespace ag::game {

// Of its things' names in their order: saves and replays are of a level with the same ones.
uint64_t levelHash(const SceneAsset& level);
std::string saveText(Game& game);
Status saveGame(Game& game, const std::string& path);
// Whether the text is a whole save of the game's level.
Status checkSave(const Game& game, const std::string& text, const std::string& path);
// Renames the file at `path`, over an earlier one of that name.
Status putSaveAside(const std::string& path, const std::string& suffix);
// What lies at `path` and is no such save is renamed to `path`.broken.
Status putBrokenSaveAside(const Game& game, const std::string& path);
// Only for a game fresh from its level; if it fails, the game is as it was.
Status restoreGame(Game& game, const std::string& text, const std::string& path);
// From the entrance of a room, with all rooms before it solved. False: there is no such room.
bool startAtRoom(Game& game, int32_t room);
Status continueGame(Game& game, const std::string& path);

}  // namespace ag::game
