// What the CPU does, in order. A system's parameters say what it touches; the schedule finds what may
// overlap.
#include "game/schedule.h"

#include "engine/renderer/probe_systems.h"
#include "engine/scene/animation_system.h"
#include "engine/scene/transform_system.h"
#include "game/systems/carry_crates.h"
#include "game/systems/flicker_lamps.h"
#include "game/systems/grow_flowers.h"
#include "game/systems/judge_rooms.h"
#include "game/systems/keep_time.h"
#include "game/systems/make_sounds.h"
#include "game/systems/move_boxes.h"
#include "game/systems/play_animations.h"
#include "game/systems/show_sky.h"
#include "game/systems/walk_player.h"

namespace ag::game {

Schedule makeTickSchedule() {
    Schedule s;
    // What the light of the frame before last says
    s.add("readProbes", render::readProbes);
    s.add("growFlowers", growFlowers);
    s.add("judgeRooms", judgeRooms);
    s.add("keepTime", keepTime);
    s.add("wakeLanterns", wakeLanterns);
    s.add("lightFlames", lightFlames);
    s.add("openPetals", openPetals);
    s.add("growHearts", growHearts);

    // The world moves
    s.add("flickerLamps", flickerLamps);
    s.add("moveBoxes", moveBoxes);
    s.add("playAnimations", playAnimations);
    s.add("animateNodes", animateNodes);
    s.add("openDoors", openDoors);
    s.add("makeBodies", makeBodies);
    s.add("keepPendulums", keepPendulums);
    s.add("walkPlayer", walkPlayer);
    s.add("carryCrates", carryCrates);
    s.add("stepPhysics", stepPhysics);
    s.add("aimLamp", aimLamp);

    // What is heard of it
    s.add("makeSounds", makeSounds);
    s.flush();
    return s;
}

Schedule makeFrameSchedule() {
    Schedule s;
    // Between the ticks
    s.add("placeBodies", placeBodies);
    s.add("followPlayer", followPlayer);

    // The renderer's view of it
    s.add("updateRootTransforms", updateRootTransforms);
    s.add("updateChildTransforms", updateChildTransforms);
    s.add("poseSkinnedMeshes", poseSkinnedMeshes);
    s.add("extractScene", extractScene);
    s.add("showSky", showSky);
    s.add("extractProbes", render::extractProbes);
    return s;
}

}  // namespace ag::game
