// Boxes that slide and turn, by the clock alone: the same tick always finds them in the same place.
#pragma once

#include "engine/ecs/view.h"
#include "engine/scene/components.h"
#include "game/components.h"

namespace ag::game {

void moveBoxes(View<LocalTransform, const Mover> boxes, Res<const GameTime> time);

}  // namespace ag::game
