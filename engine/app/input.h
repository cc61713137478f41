// What the player does in one tick, as plain data: recorded, replayed, or polled from a window.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "engine/core/result.h"

namespace ag {

enum Button : uint32_t {  // bits of Input::buttons
    kButtonLamp = 1,      // the mouse moves the lamp, not the head
    kButtonJump = 2,
    kButtonCrouch = 4,
    kButtonUse = 8,  // picks up, puts down
    kAllButtons = 15,
};

struct Input {
    float forward = 0, right = 0;  // -1..1
    glm::vec2 look{0};             // mouse movement in pixels: right, down
    uint32_t buttons = 0;          // held down
};

// Of what a replay was recorded with: a word of small letters, and what it says, on one line.
struct ReplayNote {
    std::string name, text;
    bool operator==(const ReplayNote&) const = default;
};
using ReplayNotes = std::vector<ReplayNote>;

struct Replay {
    std::vector<Input> ticks;
    ReplayNotes notes;
};

// A header, a line a note, a line a tick; equal ticks are one line with their number. A broken file is
// refused with a sentence.
Status saveReplay(const Replay& replay, const std::string& path);
Result<Replay> loadReplay(const std::string& path);

}  // namespace ag
