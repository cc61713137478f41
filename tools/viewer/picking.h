// What lies under a pixel.
#pragma once

#include "tools/viewer/light_handles.h"

namespace ag::viewer {

glm::vec3 rayThrough(const Screen& screen, glm::vec2 pixel);  // unit

struct Picked {
    uint32_t instance = 0;
    float distance = 0;  // m
};

// The nearest triangle that the ray meets; of skinned meshes the box. `eye`: relative to the scene's origin.
std::optional<Picked> pick(const RenderScene& scene, glm::vec3 eye, glm::vec3 direction);

}  // namespace ag::viewer
