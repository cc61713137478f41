// A thousand fireflies drift, burn out and are born again; one frame in a row is saved and played twice.
#include <cstdio>

#include "engine/ecs/schedule.h"
#include "engine/ecs/snapshot.h"

using namespace ag;

// Components are plain structs; an empty one is a tag.
struct Position {
    float x = 0, y = 0;  // m
};
struct Velocity {
    float x = 0, y = 0;  // m/s
};
struct Glow {
    float left = 0;  // s
};
struct Queen {};

// A resource: the world has one of it.
struct Clock {
    float step = 0.1f;  // s
};

// Systems are free functions. Their parameters say all they touch: const is read, the rest is written.
void drift(View<Position, const Velocity> flies, Res<const Clock> clock, JobRunner& jobs) {
    flies.parallel(jobs, [&](Position& at, const Velocity& v) {
        at.x += v.x * clock->step;
        at.y += v.y * clock->step;
    });
}

void burn(View<Glow, const Position, Without<Queen>> flies, Res<const Clock> clock, Commands& commands) {
    flies.each([&](Entity self, Glow& glow, const Position& at) {
        glow.left -= clock->step;
        if (glow.left > 0) return;
        commands.destroy(self);  // done at the next flush
        commands.create(at, Velocity{0, 1}, Glow{5});
    });
}

int main() {
    World world;
    world.setResource<Clock>();
    for (int i = 0; i < 1000; ++i)
        world.create(Position{float(i), 0}, Velocity{0, 1}, Glow{0.01f * float(i)});
    const Entity queen = world.create(Position{}, Velocity{0.5f, 0}, Glow{}, Queen{});

    Schedule frame;  // of two systems that conflict, the one added first runs first; others may overlap
    frame.add("drift", drift);
    frame.add("burn", burn);
    frame.flush();  // what burn asked for happens here

    JobRunner jobs;  // as many threads as the machine has; the world comes out the same with one
    for (int i = 0; i < 100; ++i)
        frame.run(world, jobs);
    const std::vector<std::byte> saved = saveWorld(world);
    frame.run(world, jobs);
    const uint64_t after = world.stateHash();
    if (!restoreWorld(world, saved)) return 1;
    frame.run(world, jobs);

    std::printf("%u entities, the queen at %.2f m, played again: %s\n", world.entityCount(),
                double(world.get<Position>(queen)->x), world.stateHash() == after ? "the same" : "different");
}
