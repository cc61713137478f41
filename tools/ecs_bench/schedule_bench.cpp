// What a graph costs that has nothing to do: 64 empty systems that read and write 32 components.
#include <utility>

#include "engine/ecs/schedule.h"
#include "tools/ecs_bench/rows.h"

namespace ag::ecs_bench {
namespace {

template <int n>
struct Thing {
    float value = 0;
};

template <int i>
void nothing(View<Thing<i * 7 % 32>, const Thing<(i * 7 + 1 + i % 5) % 32>, const Thing<(i * 7 + 9) % 32>>) {}

template <int... i>
void addAll(Schedule& s, std::integer_sequence<int, i...>) {
    (s.add("system " + std::to_string(i), nothing<i>), ...);
}

struct Graph {
    World world;
    Schedule schedule;
    JobRunner runner{2};
    Graph() { addAll(schedule, std::make_integer_sequence<int, 64>{}); }
};

}  // namespace

void addScheduleRows(Rows& rows) {
    rows.alone("64 empty systems, two threads", 10e3,
               [g = std::shared_ptr<Graph>()](benchmark::State& state) mutable {
                   if (!g) g = std::make_shared<Graph>();
                   timed(
                       state, 1, [&] { g->schedule.run(g->world, g->runner); }, Clock::kWall);
               });
}

}  // namespace ag::ecs_bench
