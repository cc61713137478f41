#include "engine/ecs/world.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <optional>
#include <random>

#include "engine/ecs/schedule.h"
#include "tests/ecs/test_components.h"

namespace ag {
namespace {

TEST(Ecs, HandlesOutliveMovesAndNeverComeBack) {
    World world;
    const Entity a = world.create(Position{1, 2, 3}), b = world.create(Position{4, 5, 6}, Health{7});
    world.add(a, Health{9});
    EXPECT_EQ(*world.get<Position>(a), (Position{1, 2, 3}));
    EXPECT_EQ(world.get<Health>(a)->points, 9);
    EXPECT_EQ(world.get<Health>(b)->points, 7);
    world.remove<Position>(a);
    EXPECT_EQ(world.get<Position>(a), nullptr);
    EXPECT_EQ(world.get<Health>(a)->points, 9);
    world.destroy(a);
    EXPECT_FALSE(world.alive(a));
    const Entity c = world.create(Health{1});
    EXPECT_EQ(c.index, a.index) << "the index is used again,";
    EXPECT_NE(c, a) << "the handle is not";
    EXPECT_EQ(world.get<Health>(a), nullptr);
    EXPECT_EQ(*world.get<Position>(b), (Position{4, 5, 6}));
}

// Random edits against a map of optionals.
TEST(Ecs, BehavesLikeANaiveModel) {
    struct Model {
        std::optional<Position> position;
        std::optional<Health> health;
        bool frozen = false;
    };
    World world;
    std::map<uint64_t, std::pair<Entity, Model>> model;
    std::mt19937 random(1);
    const auto pick = [&] {
        auto it = model.begin();
        std::advance(it, long(random() % model.size()));
        return it;
    };
    for (int i = 0; i < 20000; ++i) {
        const uint32_t what = random() % 8;
        const Position p{float(i), 1, 2};
        if (model.empty() || what < 2) {
            const Entity e = what == 0 ? world.create(p) : world.create(p, Health{i});
            model[e.bits()] = {e, {p, what == 0 ? std::optional<Health>() : Health{i}, false}};
            continue;
        }
        const auto it = pick();
        auto& [entity, m] = it->second;
        switch (what) {
            case 2:
                world.destroy(entity), model.erase(it);
                break;
            case 3:
                world.add(entity, Health{i}), m.health = Health{i};
                break;
            case 4:
                world.remove<Health>(entity), m.health.reset();
                break;
            case 5:
                world.add(entity, Frozen{}), m.frozen = true;
                break;
            case 6:
                world.remove<Position>(entity), m.position.reset();
                break;
            default:
                world.add(entity, p), m.position = p;
                break;
        }
    }
    ASSERT_EQ(world.entityCount(), model.size());
    for (const auto& [bits, pair] : model) {
        const auto& [entity, m] = pair;
        ASSERT_TRUE(world.alive(entity));
        ASSERT_EQ(world.get<Position>(entity) != nullptr, m.position.has_value());
        if (m.position) {
            ASSERT_EQ(*world.get<Position>(entity), *m.position);
        }
        ASSERT_EQ(world.get<Health>(entity) != nullptr, m.health.has_value());
        if (m.health) {
            ASSERT_EQ(*world.get<Health>(entity), *m.health);
        }
        ASSERT_EQ(world.has<Frozen>(entity), m.frozen);
    }
}

TEST(Ecs, ViewsMeetExactlyTheirRows) {
    World world;
    for (int i = 0; i < 5000; ++i) {
        const Entity e = world.create(Position{float(i), 0, 0});
        if (i % 2) world.add(e, Velocity{1, 0, 0});
        if (i % 5 == 0) world.add(e, Frozen{});
    }
    const SystemTime time{.version = 1000};
    int moving = 0, thawed = 0;
    View<Position, const Velocity>(world, time).each([&](Position& p, const Velocity& v) {
        p.y += v.x;
        ++moving;
    });
    View<const Position, With<Velocity>, Without<Frozen>>(world, time).each([&](Entity, const Position& p) {
        ASSERT_EQ(p.y, 1);
        ++thawed;
    });
    EXPECT_EQ(moving, 2500);
    EXPECT_EQ(thawed, 2000);
}

TEST(Ecs, ChangeIsSeenOnceAlsoFromALaterWriter) {
    World world;
    JobRunner one(1);
    world.setResource<Score>();
    for (int i = 0; i < 3000; ++i)
        world.create(Position{}, Health{i});
    int seen = 0, writes = 1;
    Schedule s;
    s.add("read", [&seen](View<Changed<const Health>> changed) { seen += int(changed.count()); });
    s.add("write", [&writes](View<Health> all) {
        if (writes-- > 0) all.each([](Health& h) { ++h.points; });
    });
    s.run(world, one);
    EXPECT_EQ(seen, 3000) << "all is new at first";
    seen = 0;
    s.run(world, one);
    EXPECT_EQ(seen, 3000) << "a writer late in the frame before";
    seen = 0;
    s.run(world, one);
    EXPECT_EQ(seen, 0);
}

TEST(Ecs, RowsThatSayTheyChangedAreTakenOnce) {
    World world;
    for (int i = 0; i < 5000; ++i)
        world.create(Streamed{float(i)});
    uint32_t version = world.version();
    const auto take = [&] {
        std::vector<float> taken;
        const SystemTime time{.version = version + 1, .lastRun = version - 1};
        View<Taken<const Streamed>>(world, time).each([&](const Streamed& s) { taken.push_back(s.value); });
        return taken;
    };
    EXPECT_EQ(take().size(), 5000u) << "all are new";
    EXPECT_TRUE(take().empty());
    version += 256;
    View<Streamed>(world, {.version = version}).each([](Streamed& s) {
        return s.value == 3 || s.value == 63 || s.value == 64 || s.value == 2000 || s.value == 4999;
    });
    EXPECT_EQ(take(), (std::vector<float>{3, 63, 64, 2000, 4999}));
    EXPECT_TRUE(take().empty());
}

TEST(Ecs, TakenRowsComeInRuns) {
    World world;
    std::vector<Entity> entities;
    for (int i = 0; i < 1000; ++i)
        entities.push_back(world.create(Streamed{float(i)}));
    const auto take = [&] {
        std::vector<std::pair<float, size_t>> runs;
        View<Taken<const Streamed>>(world, {.version = 1}).chunks([&](std::span<const Streamed> s) {
            runs.push_back({s[0].value, s.size()});
        });
        return runs;
    };
    using Runs = std::vector<std::pair<float, size_t>>;
    EXPECT_EQ(take(), (Runs{{0, 64}, {64, 256}, {320, 680}})) << "a run a chunk";
    for (int i : {10, 11, 12, 100, 120, 121, 127, 128, 129, 319, 320, 999})
        world.write<Streamed>(entities[size_t(i)]);
    EXPECT_EQ(take(), (Runs{{10, 3}, {100, 1}, {120, 2}, {127, 3}, {319, 1}, {320, 1}, {999, 1}}));
    EXPECT_EQ(take(), Runs{});
    world.destroy(entities[5]);
    EXPECT_EQ(take(), (Runs{{999, 1}})) << "the last row fills the hole";
}

void move(View<Position, const Velocity> things, Res<const Clock> clock) {
    things.each([&](Position& p, const Velocity& v) { p.x += v.x * clock->seconds; });
}
void damage(View<Health> all) {
    all.each([](Health& h) { h.points -= 1; });
}
void score(View<const Health> all, Res<Score> score) {
    all.each([&](const Health& h) { score->total += h.points; });
}
void bury(View<const Health> all, Commands& commands) {
    all.each([&](Entity e, const Health& h) {
        if (h.points > 0) return;
        commands.destroy(e);
        commands.create(Position{float(e.index), 0, 0}, Velocity{1, 2, 3},
                        Health{50 + int32_t(e.index % 37)});
    });
}
void fall(View<Velocity> all) {
    all.each([](Velocity& v) { v.y -= 0.01f; });
}
void land(World& world) {
    world.resource<Score>().total += int(world.entityCount());
}

Schedule exampleSchedule() {
    Schedule s;
    s.add("move", move);
    s.add("damage", damage);
    s.add("score", score);
    s.add("bury", bury);
    s.add("fall", fall);
    s.flush();
    s.add("land", land);
    return s;
}

TEST(Schedule, EdgesFollowFromSignatures) {
    Schedule s = exampleSchedule();
    EXPECT_TRUE(s.hasEdge("damage", "score")) << "Health is written, then read";
    EXPECT_TRUE(s.hasEdge("damage", "bury"));
    EXPECT_FALSE(s.ordered("score", "bury")) << "two readers";
    EXPECT_FALSE(s.ordered("move", "damage")) << "nothing in common";
    EXPECT_TRUE(s.hasEdge("move", "fall")) << "Velocity is read, then written";
    EXPECT_TRUE(s.ordered("damage", "land"));
    EXPECT_FALSE(s.hasEdge("damage", "land")) << "reached over the flush already";
    EXPECT_NE(s.graph().graphviz().find("bury"), std::string::npos);
}

uint64_t simulate(uint32_t threads) {
    World world;
    world.setResource<Clock>();
    world.setResource<Score>();
    std::mt19937 random(3);
    for (int i = 0; i < 20000; ++i) {
        const Entity e = world.create(Position{float(i), 0, 0}, Health{int32_t(random() % 150)});
        if (i % 3) world.add(e, Velocity{float(random() % 7), 0, 0});
    }
    Schedule s = exampleSchedule();
    JobRunner runner(threads);
    for (int frame = 0; frame < 200; ++frame)
        s.run(world, runner);
    EXPECT_NE(world.resource<Score>().total, 0);
    return world.stateHash() ^ uint64_t(world.resource<Score>().total);
}

TEST(Schedule, ThreadsDoNotChangeTheWorld) {
    const uint64_t serial = simulate(1);
    EXPECT_EQ(simulate(2), serial);
    EXPECT_EQ(simulate(4), serial);
}

TEST(Schedule, ParallelLoopsGiveTheSameRows) {
    World a, b;
    for (World* w : {&a, &b})
        for (int i = 0; i < 50000; ++i)
            w->create(Position{float(i), 0, 0}, Velocity{0.5f, 1, 2});
    const auto step = [](Position& p, const Velocity& v) { p.x = p.x * 0.5f + v.x, p.y += v.y; };
    JobRunner two(2);
    View<Position, const Velocity>(a, {.version = 5000}).each(step);
    View<Position, const Velocity>(b, {.version = 5000}).parallel(two, step);
    EXPECT_EQ(a.stateHash(), b.stateHash());
}

TEST(Jobs, RunInAnOrderTheEdgesAllow) {
    JobGraph graph;
    for (int i = 0; i < 64; ++i)
        graph.add("job " + std::to_string(i));
    for (uint32_t i = 0; i < 64; ++i)
        for (uint32_t j = i + 1; j < 64; ++j)
            if ((i * 7 + j) % 11 == 0) graph.edge(i, j);
    JobRunner runner(4);
    for (int repeat = 0; repeat < 50; ++repeat) {
        std::vector<std::atomic<int>> done(64);
        std::atomic<int> early{0};
        runner.run(graph, [&](uint32_t node) {
            for (uint32_t before = 0; before < node; ++before)
                if (std::ranges::count(graph.nodes[before].next, node) && !done[before]) ++early;
            done[node] = 1;
        });
        EXPECT_EQ(early, 0);
        for (auto& d : done)
            EXPECT_EQ(d, 1);
    }
}

}  // namespace
}  // namespace ag
