// Once round a scene, or once round where one stands in it.
#pragma once

#include "engine/core/bounds.h"
#include "engine/scene/static_scene.h"

namespace ag::workbench {

// The camera after `share` of a turn to the left: about the vertical axis through the middle of the scene's
// bounds where it looks at them from outside, else about its own place. `origin`: m, of the bounds, in the
// world.
CameraPose turned(const CameraPose& start, const Bounds& bounds, glm::dvec3 origin, double share);

}  // namespace ag::workbench
