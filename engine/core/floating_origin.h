// The origin that positions are taken relative to, so that floats are fine about the camera.
#pragma once

#include <glm/glm.hpp>

namespace ag {

constexpr double kOriginReach = 256;  // m: 1/50 mm

// Where the camera stood when the origin was placed, until it is farther off than floats are fine. Not on a
// grid: a scene that stands elsewhere then has the same numbers.
inline glm::dvec3 followingOrigin(glm::dvec3 before, glm::dvec3 camera) {
    const glm::dvec3 away = glm::abs(camera - before);
    return glm::max(glm::max(away.x, away.y), away.z) <= kOriginReach ? before : camera;
}

}  // namespace ag
