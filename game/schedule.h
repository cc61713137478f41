#pragma once

#include "engine/ecs/schedule.h"

namespace ag::game {

// What the CPU does each tick of 1/60 s, and each frame, which may lie between two ticks.
Schedule makeTickSchedule();
Schedule makeFrameSchedule();

}  // namespace ag::game
