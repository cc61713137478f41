// What is heard, in words: from which side, for a few seconds. Steps and clicks have none: they are the
// player's own.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/scene/static_scene.h"
#include "game/sounds.h"

namespace ag::game {

class Subtitles {
  public:
    // Sounds of a tick at `seconds`, heard by these eyes' ears; what is heard again stays longer.
    void hear(std::span<const Sound> sounds, const CameraPose& eyes, double seconds);
    // At that time, the newest last.
    std::vector<std::string> lines(double seconds) const;
    void clear() { heard_.clear(); }

    static constexpr double kSeconds = 2.5;  // that a line stays

  private:
    struct Line {
        std::string text;
        double until = 0;
    };
    std::vector<Line> heard_;
};

}  // namespace ag::game
