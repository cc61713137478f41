#include "tools/viewer/viewer_memory.h"

#include <fmt/format.h>

#include <sstream>

#include "engine/core/safe_file.h"

namespace ag::viewer {
namespace {

template <class M, class Visit>
void forFlags(M& m, Visit&& visit) {
    visit("panel", m.panel);
    visit("settings", m.settings);
    visit("passes", m.passes);
    visit("status", m.status);
    visit("profiler", m.profiler);
    visit("area_lights", m.overlay.areaLights);
    visit("reflective_maps", m.overlay.reflectiveMaps);
    visit("shadow_maps", m.overlay.shadowMaps);
    visit("fullscreen", m.window.fullscreen);
    visit("vsync", m.window.vsync);
}

}  // namespace

ViewerMemory memoryOf(const DebugUiState& panels, const PanelState& panel) {
    return {.panel = panel.open,
            .settings = panels.showSettings,
            .passes = panels.showPasses,
            .status = panels.showStatus,
            .profiler = panels.showProfiler,
            .overlay = panel.overlay,
            .window = panel.window};
}

void useMemory(const ViewerMemory& m, DebugUiState& panels, PanelState& panel) {
    panel.open = m.panel;
    panels.showSettings = m.settings;
    panels.showPasses = m.passes;
    panels.showStatus = m.status;
    panels.showProfiler = m.profiler;
    panel.overlay = m.overlay;
    panel.window = m.window;
}

std::string memoryText(const ViewerMemory& memory) {
    std::string text;
    forFlags(memory,
             [&](const char* name, bool on) { text += fmt::format("{} {}\n", name, on ? "on" : "off"); });
    return text;
}

ViewerMemory memoryFrom(std::string_view text) {
    ViewerMemory memory;
    std::istringstream words{std::string(text)};
    for (std::string name, value; words >> name >> value;)
        forFlags(memory, [&](const char* known, bool& on) {
            if (name == known && (value == "on" || value == "off")) on = value == "on";
        });
    return memory;
}

std::string memoryPath() {
    return userFolder() + "/viewer.txt";
}

}  // namespace ag::viewer
