#include "engine/app/free_camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ag {
namespace {

constexpr float kTurnPerPixel = 0.0025f;  // rad
constexpr float kSteepest = 0.5f * std::numbers::pi_v<float>;
constexpr float kApproach = 1.2f;  // 1/s: of the distance in orbit

glm::vec3 forwardOf(const FreeCamera& c) {
    return {-std::sin(c.yaw) * std::cos(c.pitch), std::sin(c.pitch), -std::cos(c.yaw) * std::cos(c.pitch)};
}

// Of the level: without roll.
glm::vec3 rightOf(const FreeCamera& c) {
    return {std::cos(c.yaw), 0, -std::sin(c.yaw)};
}

glm::vec3 upOf(const FreeCamera& c) {
    const glm::vec3 level = glm::cross(rightOf(c), forwardOf(c));
    return std::cos(c.roll) * level + std::sin(c.roll) * rightOf(c);
}

}  // namespace

FreeCamera freeCameraAt(const CameraPose& pose, const Bounds& bounds) {
    FreeCamera c;
    c.position = pose.position;
    // Who looks straight down has the heading at the top of the picture.
    const bool upright = glm::length(glm::vec2(pose.forward.x, pose.forward.z)) < 1e-4f;
    const glm::vec3 ahead =
        upright ? glm::cross(glm::vec3(0, 1, 0), rightOf(pose.forward, pose.up)) : pose.forward;
    c.yaw = std::atan2(-ahead.x, -ahead.z);
    c.pitch = std::asin(std::clamp(pose.forward.y, -1.0f, 1.0f));
    const glm::vec3 level = glm::cross(rightOf(c), forwardOf(c));
    c.roll = std::atan2(glm::dot(pose.up, rightOf(c)), glm::dot(pose.up, level));
    c.verticalFov = pose.verticalFov;
    c.near = pose.near;
    const float diagonal = bounds.empty() ? 10 : glm::length(bounds.max - bounds.min);
    c.speed = diagonal / 12;
    c.focusDistance = diagonal / 4;
    return c;
}

void moveFreely(FreeCamera& c, const Input& input, float seconds) {
    const glm::dvec3 focus = c.position + glm::dvec3(forwardOf(c)) * double(c.focusDistance);
    c.yaw -= input.look.x * kTurnPerPixel;
    c.pitch = std::clamp(c.pitch - input.look.y * kTurnPerPixel, -kSteepest, kSteepest);
    const float up = float((input.buttons & kButtonJump) != 0) - float((input.buttons & kButtonCrouch) != 0);
    if (!c.orbits) {
        const glm::vec3 way = forwardOf(c) * input.forward + rightOf(c) * input.right + glm::vec3(0, up, 0);
        c.position += glm::dvec3(way * (c.speed * seconds));
        return;
    }
    c.focusDistance *= std::exp(-kApproach * input.forward * seconds);
    const glm::vec3 aside = rightOf(c) * input.right + glm::vec3(0, up, 0);
    c.position =
        focus + glm::dvec3(aside * (c.speed * seconds)) - glm::dvec3(forwardOf(c)) * double(c.focusDistance);
}

CameraPose poseOf(const FreeCamera& c) {
    CameraPose pose;
    pose.position = c.position;
    pose.forward = forwardOf(c);
    pose.up = upOf(c);
    pose.verticalFov = c.verticalFov;
    pose.near = c.near;
    return pose;
}

}  // namespace ag
