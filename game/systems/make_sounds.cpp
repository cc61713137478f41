#include "game/systems/make_sounds.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ag::game {
namespace {

constexpr float kFullKnock = 60;         // N s, of the loudest
constexpr float kLeastLanding = 1.2f;    // m/s downwards: less is a stair
constexpr float kOpenToShut = 0.05f;     // of its petals: below, there is nothing to close
constexpr double kCrouchedStride = 0.6;  // m

using Flowers = View<const Flower, const LocalTransform>;

int placeInRoom(const Flowers& flowers, int32_t room, uint32_t node) {
    int place = 0;
    flowers.each(
        [&](const Flower& f, const LocalTransform& at) { place += f.room == room && at.node < node; });
    return place;
}

void hearFlowers(const Flowers& flowers, double seconds, Sounds& sounds) {
    flowers.each([&](Entity entity, const Flower& f, const LocalTransform& at) {
        FlowerSeen now{.bloomed = f.bloomed != 0, .blinded = f.mood == FlowerMood::kBlinded};
        const FlowerSeen before = sounds.flowers.exchange(entity, now).value_or(now);
        now.shutAt = before.shutAt;
        const glm::dvec3 head = at.translation + glm::dvec3(0, kFlowerHead, 0);
        if (now.bloomed && !before.bloomed)
            sounds.now.push_back(soundAt(head, SoundId::kBloom, 1,
                                         bloomPitch(f.wants, placeInRoom(flowers, f.room, at.node))));
        if (now.blinded && !before.blinded && f.openness > kOpenToShut &&
            seconds - before.shutAt >= kShutGap) {
            sounds.now.push_back(soundAt(head, SoundId::kShut));
            now.shutAt = seconds;
        }
        sounds.flowers.exchange(entity, now);
    });
}

void hearRooms(const View<const Room>& rooms, const View<const Door>& doors, Sounds& sounds) {
    rooms.each([&](Entity entity, const Room& room) {
        const bool solved = room.solved != 0;
        if (sounds.solved.exchange(entity, solved).value_or(solved) == solved) return;
        const glm::dvec3 below(0, double(room.half.y) * 0.75, 0);  // where lanterns hang
        sounds.now.push_back(soundAt(room.center + below, SoundId::kLanterns));
        doors.each([&](const Door& door) {
            if (door.room == room.index) sounds.now.push_back(soundAt(door.closed, SoundId::kDoor));
        });
    });
}

// Picked up, put down, and hard contacts: where a speed jumps that is neither weight nor hands.
void hearBodies(const View<const Body, const BodyState>& bodies, const Lookup<const Crate>& crates,
                const GameTime& time, Sounds& sounds) {
    Sound knock;
    float hardest = 0;  // N s
    bodies.each([&](Entity entity, const Body& body, const BodyState& state) {
        if (body.kind != BodyKind::kDynamic) return;
        const Crate* crate = crates(entity);
        const BodySeen now{state.velocity, crate && crate->carried};
        const auto before = sounds.bodies.exchange(entity, now);
        if (!before) return;
        if (now.carried != before->carried)
            sounds.now.push_back(soundAt(state.position, now.carried ? SoundId::kPickUp : SoundId::kPutDown));
        if (now.carried || before->carried) return;
        const glm::vec3 fallen(0, -kGravity * float(time.step), 0);
        const float jump = glm::length(now.velocity - before->velocity - fallen), impulse = jump * body.mass;
        if (jump < kLeastKnock || impulse <= hardest) return;
        hardest = impulse;
        const float gain = std::sqrt(std::min(impulse / kFullKnock, 1.0f));
        knock =
            soundAt(state.position, SoundId::kKnock, gain, std::clamp(std::sqrt(15 / body.mass), 0.6f, 1.6f));
    });
    if (hardest == 0 || time.seconds - sounds.knockAt < kKnockGap) return;
    sounds.knockAt = time.seconds;
    sounds.now.push_back(knock);
}

void hearFeet(const Player& player, Sounds& sounds) {
    const Character& body = player.body;
    const glm::dvec3 way = player.position - player.before;
    const double moved = std::hypot(way.x, way.z), stride = body.crouched ? kCrouchedStride : kStride;
    const bool landed = body.grounded && !sounds.grounded && sounds.fall > kLeastLanding;
    if (landed) sounds.now.push_back(soundAt(body.feet, SoundId::kLanding, std::min(sounds.fall / 5, 1.0f)));
    if (landed || moved < 1e-4)
        sounds.walked = kStride / 2;  // the first step is soon heard
    else if (body.grounded)
        sounds.walked += moved;
    if (sounds.walked >= stride && body.grounded) {
        const float foot = ++sounds.steps % 2 ? 1.0f : 0.94f;
        sounds.now.push_back(soundAt(body.feet, SoundId::kStep, body.crouched ? 0.4f : 0.8f, foot));
        sounds.walked = 0;
    }
    sounds.grounded = body.grounded != 0;
    sounds.fall = -body.velocity.y;
}

}  // namespace

// Red is low and blue is high, as light is; each further flower of a room is a step above the one before.
float bloomPitch(glm::vec3 wants, int place) {
    static constexpr std::array<float, 5> kScale = {1, 9.0f / 8, 5.0f / 4, 3.0f / 2, 5.0f / 3};
    const float most = std::max({wants.x, wants.y, wants.z, 1e-6f});
    const int step = std::max(2 + int(std::lround(2 * (wants.z - wants.x) / most)) + place, 0);
    return 0.8f * kScale[size_t(step) % kScale.size()] * float(1 << std::min(step / int(kScale.size()), 3));
}

void makeSounds(View<const Flower, const LocalTransform> flowers, View<const Room> rooms,
                View<const Door> doors, View<const Body, const BodyState> bodies, Lookup<const Crate> crates,
                Res<const Player> player, Res<const Progress> progress, Res<const GameTime> time,
                Res<Sounds> sounds) {
    sounds->now.clear();
    hearFlowers(flowers, time->seconds, *sounds);
    hearRooms(rooms, doors, *sounds);
    hearBodies(bodies, crates, *time, *sounds);
    hearFeet(*player, *sounds);
    const bool won = progress->won != 0;
    if (won && !sounds->won && sounds->listened) sounds->now.push_back(soundOf(SoundId::kFinished));
    sounds->won = won;
    sounds->listened = true;
}

}  // namespace ag::game
