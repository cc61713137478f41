// Making and destroying entities, adding and removing components, finding them by handle.
#include <algorithm>
#include <numeric>
#include <optional>
#include <random>

#include "engine/ecs/commands.h"
#include "tools/ecs_bench/kernels.h"
#include "tools/ecs_bench/plain_table.h"
#include "tools/ecs_bench/rows.h"

namespace ag::ecs_bench {
namespace {

constexpr uint32_t kCount = 100'000;
using Table = PlainTable<Position, Velocity, Acceleration>;
using WithLife = PlainTable<Position, Velocity, Acceleration, Life>;

std::vector<uint32_t> order(bool random) {
    std::vector<uint32_t> indices(kCount);
    std::iota(indices.begin(), indices.end(), 0u);
    if (random) std::ranges::shuffle(indices, std::mt19937(5));
    return indices;
}

struct Ours {
    std::optional<World> world{std::in_place};
    std::vector<Entity> entities;
    void make() {
        entities.clear();
        for (uint32_t i = 0; i < kCount; ++i)
            entities.push_back(world->create(positionOf(i), velocityOf(i), accelerationOf(i)));
    }
    void clear() {  // also what a command buffer made
        entities.clear();
        for (const Archetype& archetype : world->archetypes())
            for (const auto& chunk : archetype.chunks)
                entities.insert(entities.end(), chunk->entities, chunk->entities + chunk->rows);
        std::ranges::reverse(entities);
        world->destroy(entities);
    }
    void refill() {
        clear();
        make();
    }
};
struct Plain {
    HandleTable handles;
    Table table{handles, 0};
    WithLife withLife{handles, 1};
    std::vector<Entity> entities;
    void make() {
        entities.clear();
        for (uint32_t i = 0; i < kCount; ++i)
            entities.push_back(table.create(positionOf(i), velocityOf(i), accelerationOf(i)));
    }
    void clear() {
        table.clear();
        withLife.clear();
        entities.clear();
    }
    void refill() {
        clear();
        make();
    }
    void add(Entity entity) {
        HandleTable::Record* record = handles.find(entity);
        if (!record || record->table != 0) return;
        const uint32_t row = record->row;
        record->row = withLife.append(entity, table.column<Position>()[row], table.column<Velocity>()[row],
                                      table.column<Acceleration>()[row], Life{1});
        record->table = 1;
        table.takeOut(row);
    }
    void remove(Entity entity) {
        HandleTable::Record* record = handles.find(entity);
        if (!record || record->table != 1) return;
        const uint32_t row = record->row;
        record->row = table.append(entity, withLife.column<Position>()[row], withLife.column<Velocity>()[row],
                                   withLife.column<Acceleration>()[row]);
        record->table = 0;
        withLife.takeOut(row);
    }
};

void addCreate(Rows& rows) {
    rows.compare(
        "create 3 components, warm, 100k", 2.0,
        [w = std::make_shared<Ours>()](benchmark::State& state) {
            w->refill();
            timed(
                state, kCount, [&] { w->clear(); }, [&] { w->make(); });
        },
        [w = std::make_shared<Plain>()](benchmark::State& state) {
            w->refill();
            timed(
                state, kCount, [&] { w->clear(); }, [&] { w->make(); });
        });
    rows.compare(
        "create in bulk, cold, 100k", 1.1,
        [](benchmark::State& state) {
            std::optional<World> world;
            timed(
                state, kCount, [&] { world.emplace(); },
                [&] {
                    uint32_t next = 0;
                    world->createMany<Position, Velocity, Acceleration>(
                        kCount, [&](auto, auto position, auto velocity, auto acceleration) {
                            for (size_t i = 0; i < position.size(); ++i, ++next) {
                                position[i] = positionOf(next);
                                velocity[i] = velocityOf(next);
                                acceleration[i] = accelerationOf(next);
                            }
                        });
                });
        },
        [](benchmark::State& state) {
            std::optional<Plain> w;
            timed(
                state, kCount, [&] { w.emplace(); },
                [&] {
                    w->table.createMany(kCount, [&](uint32_t i, Position& p, Velocity& v, Acceleration& a) {
                        p = positionOf(i);
                        v = velocityOf(i);
                        a = accelerationOf(i);
                    });
                });
        });
}

// Work on each of kCount entities.
struct EntityWork {
    std::string name;
    double atMost = 0;      // see Rows::compare
    bool random = false;    // in random order
    bool withLife = false;  // on entities that have a Life
};

template <class OursWork, class PlainWork>
void addPair(Rows& rows, const EntityWork& work, OursWork ours, PlainWork plain) {
    const bool random = work.random, withLife = work.withLife;
    rows.compare(
        work.name, work.atMost,
        [=, w = std::make_shared<Ours>()](benchmark::State& state) {
            const std::vector<uint32_t> indices = order(random);
            timed(
                state, kCount,
                [&] {
                    w->refill();
                    for (size_t i = 0; withLife && i < kCount; ++i)
                        w->world->add(w->entities[i], Life{1});
                },
                [&] {
                    for (const uint32_t i : indices)
                        ours(*w->world, w->entities[i]);
                });
        },
        [=, w = std::make_shared<Plain>()](benchmark::State& state) {
            const std::vector<uint32_t> indices = order(random);
            timed(
                state, kCount,
                [&] {
                    w->refill();
                    for (size_t i = 0; withLife && i < kCount; ++i)
                        w->add(w->entities[i]);
                },
                [&] {
                    for (const uint32_t i : indices)
                        plain(*w, w->entities[i]);
                });
        });
}

void addGet(Rows& rows) {
    rows.compare(
        "checked get at random, 100k", 2.2,
        [w = std::make_shared<Ours>()](benchmark::State& state) {
            w->refill();
            const std::vector<uint32_t> indices = order(true);
            timed(state, kCount, [&] {
                float sum = 0;
                for (const uint32_t i : indices)
                    if (const Velocity* v = w->world->get<Velocity>(w->entities[i])) sum += v->mPerS.y;
                benchmark::DoNotOptimize(sum);
            });
        },
        [w = std::make_shared<Plain>()](benchmark::State& state) {
            w->refill();
            const std::vector<uint32_t> indices = order(true);
            timed(state, kCount, [&] {
                float sum = 0;
                for (const uint32_t i : indices)
                    if (const HandleTable::Record* r = w->handles.find(w->entities[i]))
                        sum += w->table.column<Velocity>()[r->row].mPerS.y;
                benchmark::DoNotOptimize(sum);
            });
        });
}

// A tenth of the entities, chosen at random, destroyed and as many made, from a buffer; arrays at once.
void addDeferred(Rows& rows) {
    constexpr uint32_t kOps = kCount / 10;
    rows.compare(
        "deferred destroy and create, 100k", 3.0,
        [w = std::make_shared<Ours>(), commands = std::make_shared<Commands>()](benchmark::State& state) {
            const std::vector<uint32_t> indices = order(true);
            timed(
                state, 2 * kOps, [&] { w->refill(); },
                [&] {
                    for (uint32_t i = 0; i < kOps; ++i) {
                        commands->destroy(w->entities[indices[i]]);
                        commands->create(positionOf(i), velocityOf(i), accelerationOf(i));
                    }
                    commands->play(*w->world);
                });
        },
        [w = std::make_shared<Plain>()](benchmark::State& state) {
            const std::vector<uint32_t> indices = order(true);
            timed(
                state, 2 * kOps, [&] { w->refill(); },
                [&] {
                    for (uint32_t i = 0; i < kOps; ++i) {
                        w->table.destroy(w->entities[indices[i]]);
                        w->table.create(positionOf(i), velocityOf(i), accelerationOf(i));
                    }
                });
        });
}

}  // namespace

void addStructureRows(Rows& rows) {
    addCreate(rows);
    for (const bool random : {false, true}) {
        const std::string how = random ? " at random, 100k" : " in order, 100k";
        addPair(
            rows, {.name = "destroy" + how, .atMost = random ? 3.2 : 2.5, .random = random},
            [](World& w, Entity e) { w.destroy(e); }, [](Plain& w, Entity e) { w.table.destroy(e); });
        addPair(
            rows, {.name = "add" + how, .atMost = random ? 5.5 : 3.5, .random = random},
            [](World& w, Entity e) { w.add(e, Life{1}); }, [](Plain& w, Entity e) { w.add(e); });
        addPair(
            rows, {.name = "remove" + how, .atMost = random ? 5.5 : 3.8, .random = random, .withLife = true},
            [](World& w, Entity e) { w.remove<Life>(e); }, [](Plain& w, Entity e) { w.remove(e); });
    }
    addGet(rows);
    addDeferred(rows);
}

}  // namespace ag::ecs_bench
