// A camera that flies freely, or circles about a point.
#pragma once

#include "engine/app/input.h"
#include "engine/core/bounds.h"
#include "engine/scene/static_scene.h"

namespace ag {

struct FreeCamera {
    glm::dvec3 position{0};  // m
    float yaw = 0;           // rad about +Y, 0: along -Z, rising to the left
    float pitch = 0;         // rad, up
    float roll = 0;          // rad, about the view: the picture's top leans to the right
    float verticalFov = 0.8f, near = 0.05f;
    float speed = 1;          // m/s
    float focusDistance = 1;  // m ahead: what is circled about
    bool orbits = false;
};

// As the pose looks; it flies through a box's diagonal in twelve seconds.
FreeCamera freeCameraAt(const CameraPose& pose, const Bounds& bounds);

// One step of so many seconds. Flying, forward and right move along the view, jump and crouch up and down; in
// orbit the mouse turns about the point ahead, forward and back come nearer and go farther.
void moveFreely(FreeCamera& camera, const Input& input, float seconds);

CameraPose poseOf(const FreeCamera& camera);

}  // namespace ag
