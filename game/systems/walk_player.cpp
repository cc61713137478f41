#include "game/systems/walk_player.h"

#include <algorithm>
#include <cmath>

namespace ag::game {
namespace {

constexpr float kRadiansPerPixel = 0.0025f;
constexpr float kMostPitch = 1.45f;   // rad
constexpr double kWalkSpeed = 2.2;    // m/s
constexpr double kBodyRadius = 0.25;  // m

glm::quat lookAlong(float yaw, float pitch) {
    return glm::angleAxis(-yaw, glm::vec3(0, 1, 0)) * glm::angleAxis(pitch, glm::vec3(1, 0, 0));
}

// Out of the box, by the shortest way, in the box's own frame.
glm::dvec2 pushOut(glm::dvec2 at, const LocalTransform& box, const Collider& collider) {
    const glm::vec3 axis = box.rotation * glm::vec3(1, 0, 0);
    const glm::dvec2 u(double(axis.x), double(axis.z)), v(-u.y, u.x);
    const glm::dvec2 offset = at - glm::dvec2(box.translation.x, box.translation.z);
    glm::dvec2 local(glm::dot(offset, u), glm::dot(offset, v));
    const glm::dvec2 reach = glm::dvec2(collider.halfSize) + kBodyRadius;
    const glm::dvec2 inside = reach - glm::abs(local);
    if (inside.x <= 0 || inside.y <= 0) return at;
    if (inside.x < inside.y)
        local.x = std::copysign(reach.x, local.x);
    else
        local.y = std::copysign(reach.y, local.y);
    return glm::dvec2(box.translation.x, box.translation.z) + u * local.x + v * local.y;
}

}  // namespace

glm::vec3 viewDirection(float yaw, float pitch) {
    return lookAlong(yaw, pitch) * glm::vec3(0, 0, -1);
}

void walkPlayer(View<const LocalTransform, const Collider> solids, Res<const Input> input,
                Res<const GameTime> time, Res<const Walkable> walkable, Res<Player> player) {
    if (!input->lampFree) {
        player->yaw = std::remainder(player->yaw + input->look.x * kRadiansPerPixel, 6.2831853f);
        player->pitch = std::clamp(player->pitch - input->look.y * kRadiansPerPixel, -kMostPitch, kMostPitch);
    }
    const glm::dvec2 ahead(std::sin(double(player->yaw)), -std::cos(double(player->yaw)));
    glm::dvec2 way = ahead * double(input->forward) + glm::dvec2(-ahead.y, ahead.x) * double(input->right);
    if (const double length = glm::length(way); length > 1) way /= length;
    glm::dvec2 at = glm::dvec2(player->position.x, player->position.z) + way * (kWalkSpeed * time->step);
    solids.each(
        [&](const LocalTransform& box, const Collider& collider) { at = pushOut(at, box, collider); });
    at = glm::clamp(at, walkable->min + kBodyRadius, walkable->max - kBodyRadius);
    player->position.x = at.x;
    player->position.z = at.y;
}

void aimLamp(View<LocalTransform, HandLamp> lamps, Res<const Input> input, Res<const Player> player) {
    lamps.each([&](LocalTransform& local, HandLamp& lamp) {
        if (input->lampFree) {
            lamp.yaw = std::clamp(lamp.yaw + input->look.x * kRadiansPerPixel, -1.2f, 1.2f);
            lamp.pitch = std::clamp(lamp.pitch - input->look.y * kRadiansPerPixel, -0.9f, 0.9f);
        }
        const glm::quat head = lookAlong(player->yaw, 0);
        const glm::dvec3 position = player->position + glm::dvec3(head * glm::vec3(0.22f, -0.25f, -0.15f));
        const float pitch = std::clamp(player->pitch + lamp.pitch, -kMostPitch, kMostPitch);
        const glm::quat rotation = lookAlong(player->yaw + lamp.yaw, pitch);
        const bool moved = local.translation != position || local.rotation != rotation;
        local.translation = position;
        local.rotation = rotation;
        return moved;
    });
}

void followPlayer(Res<const Player> player, Res<ActiveCamera> camera) {
    camera->pose.position = player->position;
    camera->pose.forward = viewDirection(player->yaw, player->pitch);
    camera->pose.verticalFov = player->verticalFov;
}

}  // namespace ag::game
