// A game being played in a window: it begins with the level, in a room or where it was saved. Keeps the save,
// the recording, the rooms reached and the best times meanwhile.
#pragma once

#include "game/demo_options.h"
#include "game/save_slot.h"
#include "game/subtitles.h"
#include "game/time_board.h"

namespace ag::game {

class Playthrough {
  public:
    Playthrough(Demo& demo, render::Renderer& renderer);

    // Errors are one sentence; the game under way stays.
    Status openTimes();
    Status startAnew();
    Status startRoom(int32_t room);
    Status continueSaved();

    void tick(const Input& input);
    // After the ticks of so many seconds: saves where a room was solved or time has passed.
    Status keep(double seconds);
    // Also on leaving; another level, a recording that plays, and a game that never began are not saved.
    void autosave();
    void begin() { begun_ = true; }  // it is under way now

    bool hasBegun() const { return begun_; }
    bool hasSave() const { return save_.exists(); }
    bool isFresh() const { return ticks_ == 0; }  // no tick was played
    std::vector<std::string> roomNotes() const { return times_.roomNotes(); }
    // What is to be read now: of times, and what is heard.
    std::string notice() const;
    std::vector<std::string> heard() const;

  private:
    Status reload();
    void isElsewhere();
    Status endRecording();
    bool isOwn() const;
    double now() const;

    Demo& demo_;
    render::Renderer& renderer_;
    SaveSlot save_;
    TimeBoard times_;
    Subtitles subtitles_;
    std::string notice_;
    double noticeUntil_ = 0;  // s of the world's time
    double sinceSave_ = 0;    // s
    uint64_t ticks_ = 0;
    uint32_t solved_ = 0;
    bool begun_ = false;
};

}  // namespace ag::game
