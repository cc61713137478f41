// Clip matrices of views from lights, shared by reflective and ordinary shadow maps. All depths are reversed.
#pragma once

#include <array>

#include <glm/glm.hpp>

#include "engine/core/bounds.h"

namespace ag::gi {

// The near plane of spots' and cubes' views over their far one: what a punctual light nearly touches stands
// in its way too. Reversed depth in floats is as exact however near it is.
constexpr float kNearOfFar = 1e-4f;

struct LightView {
    glm::mat4 clipFromWorld{1};
    float tanHalf = 1;  // of the half angle; orthographic: root of half the sides' product, m
};

// Looks along `forward`, which `up` is not.
glm::mat4 viewFromWorld(glm::vec3 position, glm::vec3 forward, glm::vec3 up);
// The same with an axis of the world chosen for up.
glm::mat4 viewFromWorld(glm::vec3 position, glm::vec3 forward);
// A square round the spot's cone (the outer angle is limited to 80 degrees).
LightView spotView(glm::vec3 position, glm::vec3 direction, float outerConeAngle, float farDistance);
// Faces +x -x +y -y +z -z of a cube, each 90 degrees.
LightView cubeFaceView(glm::vec3 position, uint32_t face, float farDistance);

// What a sun sees of a box, turned about its direction so that the rectangle round it is small: an axis of
// the world is up in it.
struct SunRectangle {
    glm::vec3 up{0};
    glm::mat4 rotation{1};  // world to the light's axes; z grows toward the sun
    Bounds seen;            // in those axes
};
// `askew`: off that axis, as a tangent, for maps whose texels shall not run along walls.
SunRectangle sunRectangle(glm::vec3 direction, const Bounds& bounds, float askew);
// That rectangle as a map, grown by `margin` of its sides.
LightView sunView(glm::vec3 direction, const Bounds& bounds, float margin);
// The part of space a view sees, its far side at a finite distance.
struct Frustum {
    std::array<glm::vec4, 6> planes;   // inside is positive; not normalised
    std::array<glm::vec3, 8> corners;  // m
};
// Of a reversed-depth clip matrix. `leastDepth`: where it ends, for those that go on for ever.
Frustum frustumOf(const glm::mat4& clipFromWorld, float leastDepth = 0);
// False only if two frusta have nothing in common; true for a few that just miss each other.
bool mayMeet(const Frustum& a, const Frustum& b);
// False only if the box is wholly outside of one of the planes.
bool mayMeet(const Frustum& f, const Bounds& box);

// How far a light's views must reach: its range, or the scene's far side.
float farDistanceOf(glm::vec3 position, float range, const Bounds& bounds);

}  // namespace ag::gi
