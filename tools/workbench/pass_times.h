// What `render --times` prints: process CPU ms of each pass.
#pragma once

#include "engine/renderer/renderer.h"
#include "tools/workbench/render_setup.h"
#include "tools/workbench/scene_options.h"

namespace ag::workbench {

// The least of some frames in which every pass runs: the first frames compile.
void printTimes(render::Renderer& renderer, const LoadedScene& loaded, const RenderSetup& settings);
// The mean over frames of a walk of `step` m each, with passes skipped as ever.
void printTimesOfWalk(render::Renderer& renderer, LoadedScene& loaded, const RenderSetup& settings,
                      glm::vec3 step);

}  // namespace ag::workbench
