// The player on foot: turns with the mouse, walks with the keys, jumps and crouches.
#pragma once

#include "engine/app/input.h"
#include "engine/physics/physics_system.h"
#include "engine/scene/extract_system.h"
#include "game/components.h"

namespace ag::game {

void walkPlayer(Res<const Input> input, Res<const GameTime> time, Res<Physics> physics, Res<Player> player);
// The lamp in the hand, below and beside the eyes: it lights what the view's middle is on, and is moved on
// its own while the button is held.
void aimLamp(View<LocalTransform, HandLamp> lamps, Res<const Input> input, Res<const GameTime> time,
             Res<const Physics> physics, Res<const Player> player);
// Between the ticks.
void followPlayer(Res<const Player> player, Res<const Physics> physics, Res<const FreeEyes> eyes,
                  Res<ActiveCamera> camera);

glm::vec3 viewDirection(float yaw, float pitch);

}  // namespace ag::game
