// What the CPU does each tick, in order. A system's parameters say what it touches; the schedule finds what
// may overlap.
#include "game/schedule.h"

#include "engine/scene/extract_system.h"
#include "engine/scene/transform_system.h"
#include "game/systems/flicker_lamps.h"
#include "game/systems/move_boxes.h"
#include "game/systems/walk_player.h"

namespace ag::game {

Schedule makeSchedule() {
    Schedule s;
    // The world moves
    s.add("moveBoxes", moveBoxes);
    s.add("flickerLamps", flickerLamps);
    s.add("walkPlayer", walkPlayer);
    s.add("aimLamp", aimLamp);
    s.add("followPlayer", followPlayer);
    s.flush();

    // The renderer's view of it
    s.add("updateRootTransforms", updateRootTransforms);
    s.add("updateChildTransforms", updateChildTransforms);
    s.add("extractScene", extractScene);
    return s;
}

}  // namespace ag::game
