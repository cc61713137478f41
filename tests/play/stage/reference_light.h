// What a flower's probe should say, by path tracing.
#pragma once

#include "tests/play/stage/stage.h"

namespace ag::game {

// The hand lamp put at `lamp`, shining at `target`; the flower's light once the renderer has settled.
gi::ProbeLight lightFlower(Stage& stage, size_t flower, glm::vec3 lamp, glm::vec3 target);
// Irradiance of one bounce at a point, the mean over all directions, W/m².
glm::vec3 referenceLight(const RenderScene& scene, glm::vec3 point);

}  // namespace ag::game
