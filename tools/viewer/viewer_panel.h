// The viewer's own panel: layer, preset, exposure, path tracing, camera and the lights.
#pragma once

#include "tools/viewer/truth_view.h"
#include "tools/viewer/viewer.h"

namespace ag::viewer {

enum class PanelEvent { kNone, kSaveSession, kSaveScene, kScreenshot, kFrameScene };

// What is shown beside ours.
enum class Beside { kNothing, kTruth, kPreset };

struct PanelState {
    bool open = true;
    std::optional<render::Layer> layer;  // none: the final picture
    std::string message;                 // of what was done last
    Beside beside = Beside::kNothing;
    BesideSettings besideSettings;
    std::string otherPreset = "high";
    std::string besideNumbers;  // of what is beside
};

// Within an ImGui frame.
PanelEvent drawPanel(PanelState& state, Viewing& viewing, ViewCamera& camera);

}  // namespace ag::viewer
