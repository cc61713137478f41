// Lamps that flicker, pulse or go on and off, by the clock alone.
#pragma once

#include "engine/ecs/view.h"
#include "engine/scene/components.h"
#include "game/components.h"

namespace ag::game {

void flickerLamps(View<PunctualLight, const Flicker> lamps, Res<const GameTime> time);

}  // namespace ag::game
