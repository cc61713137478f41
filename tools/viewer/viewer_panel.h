// The viewer's own panel: layer, preset, exposure, path tracing, camera and the lights.
#pragma once

#include "engine/app/panel_layout.h"
#include "tools/viewer/light_overlay.h"
#include "tools/viewer/selection.h"
#include "tools/viewer/truth_view.h"
#include "tools/viewer/viewer.h"

namespace ag::viewer {

enum class PanelEvent { kNone, kSaveSession, kSaveScene, kScreenshot, kFrameScene, kCapture };

// What is shown beside ours.
enum class Beside { kNothing, kTruth, kPreset };

struct WindowWishes {
    bool fullscreen = false;
    bool vsync = true;
    bool operator==(const WindowWishes&) const = default;
};

struct PanelState {
    bool open = true;
    std::optional<render::Layer> layer;  // none: the final picture
    std::string message;                 // of what was done last
    Beside beside = Beside::kNothing;
    BesideSettings besideSettings;
    std::string otherPreset = "high";
    std::string besideNumbers;  // of what is beside
    Selection selection;
    OverlaySettings overlay;
    WindowWishes window;
};

// Within an ImGui frame.
PanelEvent drawPanel(PanelState& state, const PanelLayout& layout, Viewing& viewing, FreeCamera& camera,
                     const EditedScene& edited);

}  // namespace ag::viewer
