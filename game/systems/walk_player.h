// The player on foot: turns with the mouse, walks with the keys, does not walk through walls or boxes.
#pragma once

#include "engine/app/input.h"
#include "engine/ecs/view.h"
#include "engine/scene/components.h"
#include "engine/scene/extract_system.h"
#include "game/components.h"

namespace ag::game {

void walkPlayer(View<const LocalTransform, const Collider> solids, Res<const Input> input,
                Res<const GameTime> time, Res<const Walkable> walkable, Res<Player> player);
// The lamp in the hand: below and beside the eyes, along the view, moved on its own while the button is held.
void aimLamp(View<LocalTransform, HandLamp> lamps, Res<const Input> input, Res<const Player> player);
void followPlayer(Res<const Player> player, Res<ActiveCamera> camera);

glm::vec3 viewDirection(float yaw, float pitch);

}  // namespace ag::game
