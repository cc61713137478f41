#include "game/systems/move_boxes.h"

namespace ag::game {

void moveBoxes(View<LocalTransform, const Mover> boxes, Res<const GameTime> time, JobRunner& runner) {
    moveAlong(boxes, time->seconds, runner);
}

}  // namespace ag::game
