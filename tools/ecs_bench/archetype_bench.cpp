// What many combinations of components cost, and a query that meets next to nothing.
#include "engine/ecs/view.h"
#include "tools/ecs_bench/kernels.h"
#include "tools/ecs_bench/plain_table.h"
#include "tools/ecs_bench/rows.h"

namespace ag::ecs_bench {
namespace {

constexpr uint32_t kCount = 100'000;
constexpr SystemTime kNow{.version = 1 << 20};

template <int n>
struct Tag {};

template <int... n>
void tagByBits(World& world, Entity entity, uint32_t bits, std::integer_sequence<int, n...>) {
    ((bits >> n & 1 ? world.add(entity, Tag<n>{}) : void()), ...);
}

std::shared_ptr<World> inArchetypes(uint32_t archetypes, uint32_t entities) {
    auto world = std::make_shared<World>();
    for (uint32_t i = 0; i < entities; ++i) {
        const Entity entity = world->create(positionOf(i), velocityOf(i));
        tagByBits(*world, entity, i % archetypes, std::make_integer_sequence<int, 9>{});
    }
    return world;
}

void addSpread(Rows& rows, uint32_t archetypes, double atMost) {
    rows.compare(
        std::to_string(archetypes) + " archetypes, iterate 2, 100k", atMost,
        [=, w = std::shared_ptr<World>()](benchmark::State& state) mutable {
            if (!w) w = inArchetypes(archetypes, kCount);
            timed(state, kCount, [&] {
                View<Position, const Velocity>(*w, kNow).each(
                    [](Position& p, const Velocity& v) { iterate2(p, v); });
            });
        },
        [t = std::shared_ptr<PlainTable<Position, Velocity>>()](benchmark::State& state) mutable {
            static HandleTable handles;
            if (!t) {
                t = std::make_shared<PlainTable<Position, Velocity>>(handles);
                for (uint32_t i = 0; i < kCount; ++i)
                    t->create(positionOf(i), velocityOf(i));
            }
            timed(state, kCount, [&] {
                t->each(iterate2);
                benchmark::ClobberMemory();
            });
        });
}

}  // namespace

void addArchetypeRows(Rows& rows) {
    addSpread(rows, 8, 1.5);
    addSpread(rows, 64, 1.8);
    addSpread(rows, 512, 3.2);
    rows.alone("a query over 16 entities in 8 archetypes, a call", 120,
               [w = std::shared_ptr<World>()](benchmark::State& state) mutable {
                   constexpr int kCalls = 1000;  // the clock is coarser than a call
                   if (!w) w = inArchetypes(8, 16);
                   timed(state, kCalls, [&] {
                       for (int i = 0; i < kCalls; ++i)
                           View<Position, const Velocity>(*w, kNow).each(
                               [](Position& p, const Velocity& v) { iterate2(p, v); });
                   });
               });
}

}  // namespace ag::ecs_bench
