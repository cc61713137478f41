// Which rooms were solved in what time, told as it happens, and the best of it kept in a file.
#pragma once

#include <set>

#include "game/best_times.h"
#include "game/game.h"

namespace ag::game {

class TimeBoard {
  public:
    explicit TimeBoard(std::string path) : path_(std::move(path)) {}

    // What is known from earlier. Times of another level, or a file that is none, are renamed to PATH.before
    // and the error says so: there are no best times then.
    Status open(const Game& game);
    // Another world: what is solved in it is no news.
    void startOver(Game& game);
    // After a tick. A sentence when a room was solved or the garden was reached, else nothing.
    std::string follow(Game& game);
    // The best time of each room, "" where there is none.
    std::vector<std::string> roomNotes() const;
    const BestTimes& best() const { return best_; }

  private:
    std::string tell(const char* what, double seconds, double before, bool better);

    std::string path_;
    BestTimes best_;
    std::set<int32_t> solved_;
    bool won_ = false;
};

}  // namespace ag::game
