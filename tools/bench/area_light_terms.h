// What an area light sends to a place, on the CPU: the twins of shaders/val_shading/area_light.glsl and
// shaders/ism_atlas/ism_lookup.glsl at the default shapes and taps.
#pragma once

#include "tools/bench/area_light_set.h"

namespace ag::bench {

struct Receiver {
    glm::vec3 position{0}, normal{0, 1, 0};
    float width = 0;  // m, of a gathered pixel's surface that faces the camera
};

// W/m², as if nothing stood between.
glm::vec3 polygonIrradiance(const AreaLightRead& light, const Receiver& at);  // near lights
glm::vec3 diskIrradiance(const AreaLightRead& light, const Receiver& at);     // far ones

// By the light's imperfect shadow map, 0 to 1: with soft shadows, as near lights have it, and with hard ones.
float softMapVisibility(const AreaLightSet& set, size_t light, glm::vec3 place, uint32_t taps);
float hardMapVisibility(const AreaLightSet& set, size_t light, glm::vec3 place);

// Where the light's map is seen from: before all of its texels.
inline glm::vec3 eyeOf(const AreaLightRead& light) {
    return light.val.position + light.val.normal * light.val.before;
}

}  // namespace ag::bench
