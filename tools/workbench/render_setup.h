// The settings of a frame with their registry: what --preset and --set say.
#pragma once

#include <string>
#include <vector>

#include "engine/core/settings.h"
#include "engine/frame/frame_graph.h"
#include "engine/renderer/render_settings.h"

namespace ag::workbench {

struct RenderSetup {
    render::RenderSettings gi;
    FrameGraphOptions graph;
    Settings registry;

    RenderSetup();
    RenderSetup(const RenderSetup&) = delete;  // the registry points into it
    RenderSetup& operator=(const RenderSetup&) = delete;

    Status apply(const std::string& preset, const std::vector<std::string>& assignments);
};

}  // namespace ag::workbench
