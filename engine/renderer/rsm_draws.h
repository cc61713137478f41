// Reflective shadow maps of the scene's own surfaces.
#pragma once

#include "engine/renderer/scene_gpu.h"
#include "gi/rsm.h"

namespace ag::render {

// Draws what the lights of planRsm see.
void drawRsm(GraphScope scope, const SceneView& scene, gi::RsmSet& rsm);

}  // namespace ag::render
