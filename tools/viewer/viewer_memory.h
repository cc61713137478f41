// What the viewer keeps between runs: which panels are open, what is drawn in the world, how the window is.
#pragma once

#include "engine/app/debug_ui.h"
#include "tools/viewer/viewer_panel.h"

namespace ag::viewer {

struct ViewerMemory {
    bool panel = true, settings = false, passes = false, status = true, profiler = false;
    OverlaySettings overlay;
    WindowWishes window;

    bool operator==(const ViewerMemory&) const = default;
};

ViewerMemory memoryOf(const DebugUiState& panels, const PanelState& panel);
void useMemory(const ViewerMemory& memory, DebugUiState& panels, PanelState& panel);

// A line a flag, "name on" or "name off". Lines that are none are passed over: it is no work of the user's.
std::string memoryText(const ViewerMemory& memory);
ViewerMemory memoryFrom(std::string_view text);

// viewer.txt in the user's folder.
std::string memoryPath();

}  // namespace ag::viewer
