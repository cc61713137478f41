// Rooms: solved when all their flowers are open at once; then lanterns wake, one after the other, and the
// door opens.
#pragma once

#include "engine/ecs/view.h"
#include "engine/scene/components.h"
#include "game/components.h"

namespace ag::game {

void judgeRooms(View<Room> rooms, View<Flower> flowers, Res<const Player> player, Res<const GameTime> time,
                Res<Progress> progress);
void wakeLanterns(View<const Lantern, PunctualLight> lanterns, View<const Room> rooms);
void lightFlames(View<const Lantern, LocalTransform, Without<PunctualLight>> flames, View<const Room> rooms);
void openDoors(View<const Door, LocalTransform> doors, View<const Room> rooms);

}  // namespace ag::game
