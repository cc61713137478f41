#pragma once

#include "engine/ecs/schedule.h"

namespace ag::game {

// What the CPU does each tick.
Schedule makeSchedule();

}  // namespace ag::game
