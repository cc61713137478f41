// The file of the saved game while one plays: nothing that lies there is lost to what is saved over it.
#pragma once

#include <string>

#include "game/game.h"

namespace ag::game {

class SaveSlot {
  public:
    explicit SaveSlot(std::string path) : path_(std::move(path)) {}

    const std::string& path() const { return path_; }
    bool exists() const;
    // What a new game finds there is kept beside it.
    Status makeRoomForNewGame(const Game& game);
    // False, after a warning, where nothing was saved.
    bool save(Game& game);

  private:
    // What is there and no save of this level is put aside once, not written over. False: it is still there.
    bool putBrokenAside(const Game& game);

    std::string path_;
    bool checked_ = false;
};

}  // namespace ag::game
