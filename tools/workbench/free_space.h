// Where in a scene something can hang or stand: away from surfaces, and not inside of one.
#pragma once

#include "tools/reference/ray_scene.h"

namespace ag::workbench {

// At least `clearance` (m) from what is around it, above a floor, and not within a solid.
bool isFree(const reference::RayScene& rays, glm::vec3 place, float clearance);

// Number `i` of a sequence of places that fills the box evenly, however many are taken.
glm::vec3 placeInBounds(const Bounds& bounds, uint32_t i);

}  // namespace ag::workbench
