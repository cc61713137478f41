// Paraboloids of the scene's own surfaces for screen-space VPL propagation.
#pragma once

#include "engine/renderer/scene_gpu.h"
#include "gi/published/ssvp.h"

namespace ag::render {

// Where the clusters are is known to the device alone, so every cluster draws the whole scene.
void drawParaboloids(GraphScope scope, const SceneView& scene, const gi::Paraboloids& maps);

}  // namespace ag::render
