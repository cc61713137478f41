// Crates in the hands: picked up with the use button, carried before the chest, put down with it again.
#pragma once

#include "engine/app/input.h"
#include "engine/physics/physics_system.h"
#include "game/components.h"

namespace ag::game {

// How well a crate lies to hand: the cosine from the middle of the view; 0 if it is too far, too heavy or
// hidden.
float graspOf(const PhysicsWorld& world, const Player& player, BodyId crate);

void carryCrates(View<Crate, const BodyState> crates, Res<const Input> input, Res<Physics> physics,
                 Res<Player> player);

}  // namespace ag::game
