#include "game/systems/carry_crates.h"

#include <algorithm>

#include "game/systems/walk_player.h"

namespace ag::game {
namespace {

constexpr double kReach = 2.3;         // m from the eyes to its middle
constexpr double kLeastCosine = 0.75;  // from the middle of the view
constexpr float kHold = 1.25f;         // m before the eyes
constexpr float kMostSpeed = 5;        // m/s of what is carried
constexpr float kMostMass = 20;        // kg
constexpr double kLetGo = 1.6;         // m from where it should be: something holds it back

glm::vec3 holdDirection(const Player& player) {
    return viewDirection(player.yaw, std::clamp(player.pitch, -0.5f, 0.3f));
}

void carry(PhysicsWorld& world, BodyId body, const Player& player, float step) {
    const glm::dvec3 wanted =
        player.position + glm::dvec3(holdDirection(player) * kHold) - glm::dvec3(0, 0.35, 0);
    glm::vec3 velocity = glm::vec3(wanted - world.pose(body).position) * (0.25f / step);
    if (const float speed = glm::length(velocity); speed > kMostSpeed) velocity *= kMostSpeed / speed;
    world.setVelocity(body, velocity, world.spin(body) * 0.8f);
}

}  // namespace

float graspOf(const PhysicsWorld& world, const Player& player, BodyId crate) {
    if (world.mass(crate) > kMostMass) return 0;
    const glm::dvec3 center = world.pose(crate).position, d = center - player.position;
    const double distance = glm::length(d);
    if (distance > kReach) return 0;
    const double cosine = glm::dot(d / distance, glm::dvec3(viewDirection(player.yaw, player.pitch)));
    const auto hit = cosine < kLeastCosine ? std::nullopt : world.ray(player.position, center);
    return hit && hit->body == crate ? float(cosine) : 0;
}

void carryCrates(View<Crate, const BodyState> crates, Res<const Input> input, Res<Physics> physics,
                 Res<Player> player) {
    const bool pressed = input->buttons & ~player->buttonsBefore & kButtonUse;
    player->buttonsBefore = input->buttons;
    PhysicsWorld& world = *physics->world;
    BodyId wanted = kNoBody;
    float best = 0;
    crates.each([&](Crate&, const BodyState& state) {
        const float grasp = pressed && !player->carried ? graspOf(world, *player, state.body) : 0;
        if (grasp > best) wanted = state.body;
        best = std::max(best, grasp);
        return false;
    });
    crates.each([&](Entity entity, Crate& crate, const BodyState& state) {
        if (crate.carried) {
            const glm::dvec3 hands = player->position + glm::dvec3(holdDirection(*player) * kHold);
            if (pressed || glm::distance(world.pose(state.body).position, hands) > kLetGo) {
                world.setCarried(state.body, false);
                crate.carried = 0;
                player->carried = {};
                return true;
            }
            carry(world, state.body, *player, physics->tick);
            return false;
        }
        if (state.body != wanted) return false;
        world.setCarried(state.body, true);
        crate.carried = 1;
        player->carried = entity;
        return true;
    });
}

}  // namespace ag::game
