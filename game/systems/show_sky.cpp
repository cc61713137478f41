#include "game/systems/show_sky.h"

#include <cstdlib>

namespace ag::game {

void showSky(View<const Room> rooms, Res<const Progress> progress, Res<const LevelSky> level,
             Res<RenderScene> scene) {
    bool any = false, seen = false;
    rooms.each([&](const Room& room) {
        any = true;
        seen = seen || (room.openToSky && std::abs(room.index - progress->room) <= 1);
    });
    const bool everywhere = level->everywhere || !any;
    if (!everywhere && progress->room < 0) return;  // between rooms it stays as it is
    scene->sky = everywhere || seen ? level->sky : nullptr;
}

}  // namespace ag::game
