#include "game/systems/walk_player.h"

#include <algorithm>
#include <cmath>

namespace ag::game {
namespace {

constexpr float kRadiansPerPixel = 0.0025f;
constexpr float kMostPitch = 1.45f;                        // rad
constexpr float kEyesBelowTop = 0.13f;                     // m
constexpr glm::vec3 kHand(0.18f, -0.22f, -0.12f);          // m from the eyes, where the lamp is
constexpr float kNearestFocus = 0.8f, kFarthestFocus = 8;  // m
constexpr float kFocusRate = 8;                            // 1/s
constexpr float kCrouchRate = 4.5f;                        // m/s the eyes sink or rise

glm::quat lookAlong(float yaw, float pitch) {
    return glm::angleAxis(-yaw, glm::vec3(0, 1, 0)) * glm::angleAxis(pitch, glm::vec3(1, 0, 0));
}

// Towards the distance of what the view's middle is on, not at once, so that the beam does not jump at edges.
float focused(const PhysicsWorld& physics, const Player& player, float before, float seconds) {
    const glm::dvec3 ahead(viewDirection(player.yaw, player.pitch));
    const auto hit = physics.ray(player.position, player.position + ahead * double(kFarthestFocus));
    const float wanted = std::max(kNearestFocus, kFarthestFocus * (hit ? hit->share : 1));
    if (std::abs(wanted - before) < 1e-3f) return wanted;  // and then it rests
    return glm::mix(before, wanted, std::min(kFocusRate * seconds, 1.0f));
}

}  // namespace

glm::vec3 viewDirection(float yaw, float pitch) {
    return lookAlong(yaw, pitch) * glm::vec3(0, 0, -1);
}

void walkPlayer(Res<const Input> input, Res<const GameTime> time, Res<Physics> physics, Res<Player> player) {
    if (!(input->buttons & kButtonLamp)) {
        player->yaw = std::remainder(player->yaw + input->look.x * kRadiansPerPixel, 6.2831853f);
        player->pitch = std::clamp(player->pitch - input->look.y * kRadiansPerPixel, -kMostPitch, kMostPitch);
    }
    const glm::vec2 ahead(std::sin(player->yaw), -std::cos(player->yaw));
    const CharacterIntent intent{.way = ahead * input->forward + glm::vec2(-ahead.y, ahead.x) * input->right,
                                 .jump = (input->buttons & ~player->buttonsBefore & kButtonJump) != 0,
                                 .crouch = (input->buttons & kButtonCrouch) != 0};
    const float step = float(time->step);
    moveCharacter(*physics->world, player->body, intent, {}, step);
    const float wanted = player->body.height - kEyesBelowTop;
    player->eyeHeight += std::clamp(wanted - player->eyeHeight, -kCrouchRate * step, kCrouchRate * step);
    player->before = player->position;
    player->position = player->body.feet + glm::dvec3(0, double(player->eyeHeight), 0);
}

void aimLamp(View<LocalTransform, HandLamp> lamps, Res<const Input> input, Res<const GameTime> time,
             Res<const Physics> physics, Res<const Player> player) {
    lamps.each([&](LocalTransform& local, HandLamp& lamp) {
        if (input->buttons & kButtonLamp) {
            lamp.yaw = std::clamp(lamp.yaw + input->look.x * kRadiansPerPixel, -1.2f, 1.2f);
            lamp.pitch = std::clamp(lamp.pitch - input->look.y * kRadiansPerPixel, -0.9f, 0.9f);
        }
        lamp.focus = focused(*physics->world, *player, lamp.focus, float(time->step));
        const glm::vec3 hand = lookAlong(player->yaw, 0) * kHand;
        const glm::dvec3 position = player->position + glm::dvec3(hand);
        const float pitch = std::clamp(player->pitch + lamp.pitch, -kMostPitch, kMostPitch);
        const glm::vec3 beam = viewDirection(player->yaw + lamp.yaw, pitch) * lamp.focus - hand;
        const glm::quat rotation = lookAlong(std::atan2(beam.x, -beam.z),
                                             std::atan2(beam.y, glm::length(glm::vec2(beam.x, beam.z))));
        const bool moved = local.translation != position || local.rotation != rotation;
        local.translation = position;
        local.rotation = rotation;
        return moved;
    });
}

void followPlayer(Res<const Player> player, Res<const Physics> physics, Res<const FreeEyes> eyes,
                  Res<ActiveCamera> camera) {
    if (eyes->open) {
        camera->pose = eyes->pose;
        return;
    }
    camera->pose.position = physics->share >= 1
                                ? player->position
                                : glm::mix(player->before, player->position, double(physics->share));
    camera->pose.forward = viewDirection(player->yaw, player->pitch);
    camera->pose.up = glm::vec3(0, 1, 0);  // a level's camera may be tilted, heads are not
    camera->pose.verticalFov = player->verticalFov;
}

}  // namespace ag::game
