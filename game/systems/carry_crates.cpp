#include "game/systems/carry_crates.h"

#include <algorithm>

#include "game/systems/walk_player.h"

namespace ag::game {
namespace {

constexpr double kReach = 2.2;   // m from the eyes
constexpr float kHold = 1.25f;   // m before the eyes
constexpr float kMostSpeed = 5;  // m/s of what is carried
constexpr float kMostMass = 20;  // kg
constexpr double kLetGo = 1.6;   // m from where it should be: something holds it back

glm::vec3 holdDirection(const Player& player) {
    return viewDirection(player.yaw, std::clamp(player.pitch, -0.5f, 0.3f));
}

// The crate the player looks at, within reach and not too heavy.
BodyId crateInView(const Physics& physics, const Player& player) {
    const glm::dvec3 to = player.position + glm::dvec3(viewDirection(player.yaw, player.pitch)) * kReach;
    const auto hit = physics.world->ray(player.position, to);
    if (!hit || physics.world->kind(hit->body) != BodyKind::kDynamic) return kNoBody;
    return physics.world->mass(hit->body) <= kMostMass ? hit->body : kNoBody;
}

void carry(PhysicsWorld& world, BodyId body, const Player& player, float step) {
    const glm::dvec3 wanted =
        player.position + glm::dvec3(holdDirection(player) * kHold) - glm::dvec3(0, 0.35, 0);
    glm::vec3 velocity = glm::vec3(wanted - world.pose(body).position) * (0.25f / step);
    if (const float speed = glm::length(velocity); speed > kMostSpeed) velocity *= kMostSpeed / speed;
    world.setVelocity(body, velocity, world.spin(body) * 0.8f);
}

}  // namespace

void carryCrates(View<Crate, const BodyState> crates, Res<const Input> input, Res<Physics> physics,
                 Res<Player> player) {
    const bool pressed = input->buttons & ~player->buttonsBefore & kButtonUse;
    player->buttonsBefore = input->buttons;
    const BodyId wanted = pressed && !player->carried ? crateInView(*physics, *player) : kNoBody;
    PhysicsWorld& world = *physics->world;
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
