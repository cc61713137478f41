// The viewer's own panel: layer, preset, exposure, camera and the lights.
#pragma once

#include "tools/viewer/viewer.h"

namespace ag::viewer {

enum class PanelEvent { kNone, kSaveSession, kScreenshot, kFrameScene };

struct PanelState {
    bool open = true;
    std::optional<render::Layer> layer;  // none: the final picture
    std::string message;                 // of what was done last
};

// Within an ImGui frame.
PanelEvent drawPanel(PanelState& state, Viewing& viewing, ViewCamera& camera);

}  // namespace ag::viewer
