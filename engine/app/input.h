// What the player does in one tick, as plain data: recorded, replayed, or polled from a window.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "engine/core/result.h"

namespace ag {

struct Input {
    float forward = 0, right = 0;  // -1..1
    glm::vec2 look{0};             // mouse movement in pixels: right, down
    uint32_t lampFree = 0;         // 1: the mouse moves the lamp, not the head
};

// One line a tick after a header; a broken file is refused with a sentence.
Status saveReplay(const std::vector<Input>& ticks, const std::string& path);
Result<std::vector<Input>> loadReplay(const std::string& path);

}  // namespace ag
