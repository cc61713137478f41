// Cascades of a sun: spheres round slices of the camera's frustum cut to the scene, moved in whole texels so
// that edges do not crawl.
#pragma once

#include "engine/core/render_camera.h"
#include "gi/light_views.h"

namespace ag::render {

struct Cascade {
    glm::mat4 clipFromWorld{1};
    glm::vec2 size{0};      // m across
    float farDistance = 0;  // m along the camera's axis
};

// Distance along the camera's axis where slice `index` of `count` ends.
float cascadeEnd(uint32_t index, uint32_t count, float near, float far, float logShare);

// What the camera sees between two distances along its axis, m.
struct FrustumSlice {
    const RenderCamera& camera;
    float aspect = 1;  // width / height
    float near = 0, far = 0;
};

// `extent`: of the scene, see steadyExtent(); the grid that sizes are rounded to follows it. `resolution`:
// texels a side.
Cascade fitCascade(const FrustumSlice& slice, glm::vec3 sunDirection, const Bounds& casters, float extent,
                   uint32_t resolution);

}  // namespace ag::render
