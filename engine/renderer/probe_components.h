// Light for gameplay: give an entity an IrradianceProbe and a ProbeLight, and read there what falls on it.
#pragma once

#include <glm/glm.hpp>

#include "engine/ecs/entity.h"

namespace ag::render {

struct IrradianceProbe {
    glm::vec3 offset{0};  // m, in the entity's frame
    glm::vec3 normal{0};  // in the entity's frame, unit; zero: the mean over all directions
};

struct ProbeLight {                   // written by readProbes
    glm::vec3 direct{0}, bounced{0};  // W/m²
    uint32_t measured = 0;            // 0: nothing is known yet
};

}  // namespace ag::render
