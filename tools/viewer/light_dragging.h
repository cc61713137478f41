// Lights as handles in the picture, dragged with the mouse.
#pragma once

#include "tools/viewer/light_handles.h"
#include "tools/viewer/viewer.h"

namespace ag::viewer {

struct LightDragging {
    std::optional<size_t> held;  // of the handles
};

// Within an ImGui frame: draws the handles beneath the panels and moves the light, or the sky's sun, whose
// handle is held. True: one is.
bool dragLights(LightDragging& state, Viewing& viewing, const FreeCamera& camera, glm::vec2 size);

}  // namespace ag::viewer
