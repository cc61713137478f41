// Players of animations go on by a tick.
#pragma once

#include "engine/scene/animation_system.h"
#include "game/components.h"

namespace ag::game {

void playAnimations(View<AnimationPlayer> players, Res<const SkinnedMeshLibrary> library,
                    Res<const GameTime> time, JobRunner& runner);

}  // namespace ag::game
