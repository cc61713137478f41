#include "game/systems/play_animations.h"

namespace ag::game {

void playAnimations(View<AnimationPlayer> players, Res<const SkinnedMeshLibrary> library,
                    Res<const GameTime> time, JobRunner& runner) {
    advancePlayers(players, *library, float(time->step), runner);
}

}  // namespace ag::game
