// What is heard of the world: sounds for what changed in the tick. It only looks: nothing that the rules read
// is written, so that the world is the same with and without ears.
#pragma once

#include <optional>

#include "engine/ecs/view.h"
#include "engine/physics/physics_system.h"
#include "engine/scene/components.h"
#include "game/components.h"
#include "game/sounds.h"

namespace ag::game {

constexpr double kKnockGap = 0.16;   // s between two knocks at least: the loudest of a tick is heard
constexpr double kStride = 1.1;      // m walked between two footsteps, upright
constexpr float kLeastKnock = 0.7f;  // m/s by which a body's speed must jump
constexpr double kShutGap = 2;       // s before the same flower is heard closing again

// A value by entity, as it was when it was last looked at.
template <class T>
class LastSeen {
  public:
    // What it was, or none the first time.
    std::optional<T> exchange(Entity entity, const T& now) {
        if (rows_.size() <= entity.index) rows_.resize(entity.index + 1);
        Row& row = rows_[entity.index];
        const Row before = row;
        row = {entity.generation, true, now};
        if (!before.seen || before.generation != entity.generation) return std::nullopt;
        return before.value;
    }

  private:
    struct Row {
        uint32_t generation = 0;
        bool seen = false;
        T value{};
    };
    std::vector<Row> rows_;
};

struct FlowerSeen {
    bool bloomed = false, blinded = false;
    double shutAt = -kShutGap;  // s, when it was last heard closing
};

struct BodySeen {
    glm::vec3 velocity{0};  // m/s
    bool carried = false;
};

// Resource
struct Sounds {
    std::vector<Sound> now;  // of the last tick

    // What was, to tell what changed.
    LastSeen<FlowerSeen> flowers;
    LastSeen<bool> solved;  // rooms
    LastSeen<BodySeen> bodies;
    double walked = 0;            // m since the last footstep
    uint32_t steps = 0;           // taken
    float fall = 0;               // m/s downwards
    double knockAt = -kKnockGap;  // s
    bool grounded = false, won = false, listened = false;
};

void makeSounds(View<const Flower, const LocalTransform> flowers, View<const Room> rooms,
                View<const Door> doors, View<const Body, const BodyState> bodies, Lookup<const Crate> crates,
                Res<const Player> player, Res<const Progress> progress, Res<const GameTime> time,
                Res<Sounds> sounds);

// Of a flower's chime, by the colour it wants and its place among those of its room.
float bloomPitch(glm::vec3 wants, int place);

}  // namespace ag::game
