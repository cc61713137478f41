// Crates in the hands: picked up with the use button, carried before the chest, put down with it again.
#pragma once

#include "engine/app/input.h"
#include "engine/physics/physics_system.h"
#include "game/components.h"

namespace ag::game {

void carryCrates(View<Crate, const BodyState> crates, Res<const Input> input, Res<Physics> physics,
                 Res<Player> player);

}  // namespace ag::game
