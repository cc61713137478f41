// How long a player takes, by the world's own clock.
#pragma once

#include "engine/ecs/view.h"
#include "game/components.h"

namespace ag::game {

// Until the gallery is lit; each room's time runs while the player is in it and it is not solved.
void keepTime(View<const Room> rooms, Res<const Progress> progress, Res<const GameTime> time,
              Res<PlayTime> played);

}  // namespace ag::game
