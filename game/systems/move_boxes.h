// Boxes that slide and turn, by the clock alone: the same tick always finds them in the same place.
#pragma once

#include "engine/scene/mover.h"
#include "game/components.h"

namespace ag::game {

void moveBoxes(View<LocalTransform, const Mover> boxes, Res<const GameTime> time, JobRunner& runner);

}  // namespace ag::game
