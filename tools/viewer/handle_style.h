// How handles in the picture look.
#pragma once

#include <imgui.h>

#include <glm/glm.hpp>

namespace ag::viewer {

constexpr float kHandleRadius = 6;  // pixels at scale 1; of squares half a side
constexpr ImU32 kHandleOutline = IM_COL32(0, 0, 0, 255), kHandleHeld = IM_COL32(255, 255, 255, 255);

inline ImVec2 toImGui(glm::vec2 v) {
    return {v.x, v.y};
}

}  // namespace ag::viewer
