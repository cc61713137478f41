#include "game/systems/keep_time.h"

namespace ag::game {

void keepTime(View<const Room> rooms, Res<const Progress> progress, Res<const GameTime> time,
              Res<PlayTime> played) {
    if (!progress->won && played->known) played->whole += time->step;
    rooms.each([&](const Room& room) {
        if (room.index != progress->room || room.solved || room.flowers == 0) return;
        if (size_t(room.index) >= played->rooms.size()) played->rooms.resize(size_t(room.index) + 1);
        played->rooms[size_t(room.index)] += time->step;
    });
}

}  // namespace ag::game
