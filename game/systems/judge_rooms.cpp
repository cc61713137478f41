#include "game/systems/judge_rooms.h"

#include <algorithm>

namespace ag::game {
namespace {

constexpr float kWakeSeconds = 0.8f, kDoorSeconds = 1.6f, kAsleep = 0.02f;
constexpr float kLeastProgress = 0.01f;  // of a flower, opened

// s since the room was solved; negative if it is not.
float sinceSolved(const View<const Room>& rooms, int32_t index) {
    float since = -1;
    rooms.each([&](const Room& room) {
        if (room.index == index && room.solved) since = room.since;
    });
    return since;
}

float eased(float t) {
    t = std::clamp(t, 0.0f, 1.0f);
    return t * t * (3 - 2 * t);
}

bool inside(const Room& room, glm::dvec3 p) {
    const glm::dvec3 d = glm::abs(p - room.center);
    return d.x < double(room.half.x) && d.z < double(room.half.z);
}

}  // namespace

void judgeRooms(View<Room> rooms, View<Flower> flowers, Res<const Player> player, Res<const GameTime> time,
                Res<Progress> progress) {
    Progress now{.room = progress->room};  // porches and corridors belong to the room one comes from
    // A room without flowers is lit when all the others are.
    const bool allSolved = progress->rooms > 0 && progress->roomsSolved == progress->rooms;
    int32_t last = -1;
    rooms.each([&](Room& room) {
        const Room before = room;
        room.flowers = room.open = 0;
        flowers.each([&](Flower& flower) {
            if (flower.room != room.index) return false;
            ++room.flowers;
            room.open += flower.bloomed;
            if (!room.solved || flower.mood == FlowerMood::kOpen) return false;
            flower.mood = FlowerMood::kOpen;
            return true;
        });
        room.solved = room.solved || (room.flowers > 0 ? room.open == room.flowers : allSolved);
        if (room.solved && room.since < 60) room.since += float(time->step);
        now.rooms += room.flowers > 0;
        now.roomsSolved += room.flowers > 0 && room.solved;
        now.flowers += room.flowers;
        now.flowersOpen += room.solved ? room.flowers : room.open;
        if (inside(room, player->position)) now.room = room.index;
        last = std::max(last, room.index);
        return room.open != before.open || room.flowers != before.flowers || room.since != before.since;
    });
    // Whatever opened further than ever is progress.
    now.idle = progress->idle + float(time->step);
    now.best = now.room == progress->room ? progress->best : 0;
    float open = 0;
    flowers.each([&](Flower& flower) {
        if (flower.room == now.room) open += flower.openness;
        return false;
    });
    if (now.room != progress->room || open > now.best + kLeastProgress) {
        now.idle = 0;
        now.best = open;
    }
    const bool all = now.flowers > 0 && now.roomsSolved == now.rooms;
    now.won = progress->won || (all && now.room == last);
    *progress = now;
}

void wakeLanterns(View<const Lantern, PunctualLight> lanterns, View<const Room> rooms) {
    lanterns.each([&](const Lantern& lantern, PunctualLight& light) {
        const float since = sinceSolved(rooms, lantern.room);
        const glm::vec3 intensity = lantern.intensity * eased((since - lantern.delay) / kWakeSeconds);
        if (light.intensity == intensity) return false;
        light.intensity = intensity;
        return true;
    });
}

void lightFlames(View<const Lantern, LocalTransform, Without<PunctualLight>> flames, View<const Room> rooms) {
    flames.each([&](const Lantern& lantern, LocalTransform& local) {
        const float awake = eased((sinceSolved(rooms, lantern.room) - lantern.delay) / kWakeSeconds);
        const glm::vec3 scale(std::max(awake, kAsleep));
        if (local.scale == scale) return false;
        local.scale = scale;
        return true;
    });
}

void openDoors(View<const Door, LocalTransform> doors, View<const Room> rooms) {
    doors.each([&](const Door& door, LocalTransform& local) {
        const double open = double(eased(sinceSolved(rooms, door.room) / kDoorSeconds));
        const glm::dvec3 position = door.closed - glm::dvec3(0, double(door.height) * open, 0);
        if (local.translation == position) return false;
        local.translation = position;
        return true;
    });
}

}  // namespace ag::game
