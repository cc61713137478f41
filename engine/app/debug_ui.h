// The panels over a running program: every setting, every pass with its time and what became of it, and the
// world's entities.
#pragma once

#include "engine/app/input_events.h"
#include "engine/app/inspector.h"
#include "engine/app/panel_layout.h"
#include "engine/app/profiler_overlay.h"
#include "engine/core/function_ref.h"
#include "engine/core/settings.h"
#include "engine/frame/frame_graph.h"

struct GLFWwindow;

namespace ag {

struct DebugUiState {
    bool showSettings = false;  // F1
    bool showPasses = false;    // F2
    bool showStatus = false;    // F3
    bool showWorld = false;     // F4
    bool showProfiler = false;  // F9
    float profilerBudgetMs = 1000.0f / 60;
};

// Within an ImGui frame.
PanelLayout panelLayout(const DebugUiState& state);

// ImGui's context with GLFW's events; one at a time.
class DebugUi {
  public:
    explicit DebugUi(GLFWwindow* window);
    ~DebugUi();
    DebugUi(const DebugUi&) = delete;
    DebugUi& operator=(const DebugUi&) = delete;

    // Builds this frame's panels and what `game` adds; their draw data is ready when it returns.
    void build(DebugUiState& state, const Pointer& pointer, Settings& settings, const FrameGraph& graph,
               const World& world, const std::string& status, FunctionRef<void()> game);
    bool holdsMouse() const;  // a button is down: what is dragged is still being dragged
    bool takesText() const;   // a field is being typed into: keys are not for the program

  private:
    Inspector inspector_;
    PassHistory history_;
};

}  // namespace ag
