// Clip matrices of views from lights, shared by reflective and ordinary shadow maps. All depths are reversed.
#pragma once

#include <array>

#include <glm/glm.hpp>

#include "engine/scene/render_scene.h"

namespace ag::gi {

struct LightView {
    glm::mat4 clipFromWorld{1};
    float tanHalf = 1;  // of the half angle; orthographic: half the width in m
};

// Looks along `forward`; up is chosen away from it.
glm::mat4 viewFromWorld(glm::vec3 position, glm::vec3 forward);
// A square round the spot's cone (the outer angle is limited to 80 degrees).
LightView spotView(const RenderLight& light, float nearDistance, float farDistance);
// Faces +x -x +y -y +z -z of a cube, each 90 degrees.
LightView cubeFaceView(glm::vec3 position, uint32_t face, float nearDistance, float farDistance);
// A square over the bounds as the sun sees them, grown by `margin` of its width.
LightView sunView(glm::vec3 direction, const Bounds& bounds, float margin);
// How far a light's views must reach: its range, or the scene's far side.
float farDistanceOf(const RenderLight& light, const Bounds& bounds);

}  // namespace ag::gi
