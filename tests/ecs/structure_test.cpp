// Commands, bulk creation, tags, and loops on several threads.
#include <gtest/gtest.h>

#include <numeric>
#include <set>

#include "engine/ecs/schedule.h"
#include "tests/ecs/test_components.h"

namespace ag {
namespace {

TEST(Commands, DoWhatTheWorldWouldDoAtOnce) {
    World now, later;
    std::vector<Entity> entities;
    for (int i = 0; i < 3000; ++i) {
        entities.push_back(now.create(Position{float(i), 0, 0}));
        ASSERT_EQ(later.create(Position{float(i), 0, 0}), entities.back());
    }
    Commands commands;
    for (int round = 0; round < 2; ++round) {  // a buffer used again starts clean
        for (size_t i = size_t(round); i < entities.size(); i += 3) {
            now.add(entities[i], Health{int32_t(i)});
            commands.add(entities[i], Health{int32_t(i)});
            if (i % 2) {
                now.destroy(entities[i]);
                commands.destroy(entities[i]);
            }
            now.remove<Position>(entities[i]);
            commands.remove<Position>(entities[i]);
        }
        EXPECT_NE(now.stateHash(), later.stateHash());
        commands.play(later);
        EXPECT_TRUE(commands.empty());
        EXPECT_EQ(now.stateHash(), later.stateHash());
    }
    for (int i = 0; i < 700; ++i) {
        commands.create(Health{i}, Position{1, 2, float(i)});
        now.create(Health{i}, Position{1, 2, float(i)});
    }
    commands.play(later);
    EXPECT_EQ(now.stateHash(), later.stateHash())
        << "bulk creation fills the same rows with the same handles";
}

TEST(Commands, CreatedTogetherByTheirComponents) {
    World world;
    Commands commands;
    for (int i = 0; i < 1000; ++i) {
        commands.create(Position{float(i), 0, 0});
        commands.create(Health{i}, Marked{});
    }
    commands.play(world);
    EXPECT_EQ(world.entityCount(), 2000u);
    int next = 0;
    View<const Health, With<Marked>>(world, {}).each([&](Entity e, const Health& h) {
        EXPECT_EQ(h.points, next++);
        EXPECT_TRUE(world.alive(e));
    });
    EXPECT_EQ(next, 1000);
}

TEST(Ecs, BulkCreationIsCreationManyTimes) {
    World one, bulk;
    for (World* w : {&one, &bulk}) {  // free handles first, then new ones
        std::vector<Entity> gone;
        for (int i = 0; i < 40; ++i)
            gone.push_back(w->create(Health{i}));
        w->destroy(gone);
    }
    for (int i = 0; i < 5000; ++i)
        one.create(Position{float(i), 0, 0}, Health{i});
    int next = 0;
    std::set<uint64_t> handles;
    bulk.createMany<Position, Health>(5000, [&](std::span<const Entity> entities,
                                                std::span<Position> positions, std::span<Health> healths) {
        for (size_t i = 0; i < positions.size(); ++i, ++next) {
            positions[i] = {float(next), 0, 0};
            healths[i] = {next};
            handles.insert(entities[i].bits());
            ASSERT_EQ(bulk.get<Health>(entities[i]), &healths[i]);
        }
    });
    EXPECT_EQ(next, 5000);
    EXPECT_EQ(handles.size(), 5000u);
    EXPECT_EQ(one.stateHash(), bulk.stateHash());
}

TEST(Ecs, TagsCostNoBytesAndCanBeAskedFor) {
    World world;
    std::vector<Entity> entities;
    for (int i = 0; i < 300; ++i)
        entities.push_back(world.create(Health{i}));
    for (size_t i = 0; i < 300; i += 3)
        world.add(entities[i], Marked{});
    EXPECT_EQ(componentType(componentId<Marked>()).sizeBytes, 0u);
    int sum = 0;
    View<const Health, With<Marked>>(world, {}).each([&](const Health& h) { sum += h.points; });
    EXPECT_EQ(sum, 3 * 99 * 100 / 2);
    EXPECT_EQ((View<const Health, Without<Marked>>(world, {}).count()), 200u);
    EXPECT_TRUE(world.has<Marked>(entities[3]));
    world.remove<Marked>(entities[3]);
    EXPECT_FALSE(world.has<Marked>(entities[3]));
    EXPECT_EQ(world.get<Health>(entities[3])->points, 3);
}

TEST(Ecs, ViewsMeetArchetypesMadeAfterThem) {
    World world;
    world.create(Position{});
    const auto count = [&] { return View<const Position, Without<Frozen>>(world, {}).count(); };
    EXPECT_EQ(count(), 1u);
    const Entity e = world.create(Position{}, Health{});
    EXPECT_EQ(count(), 2u);
    world.add(e, Frozen{});
    EXPECT_EQ(count(), 1u);
}

TEST(Ecs, ChangedAndUnchangedPartTheWorld) {
    World world;
    for (int i = 0; i < 4000; ++i)
        world.create(Position{float(i), 0, 0});
    const Entity far = world.create(Position{-1, 0, 0}, Health{});
    const SystemTime time{.version = world.version() + 9, .lastRun = world.version()};
    const auto counts = [&] {
        return std::pair(View<Changed<const Position>>(world, time).count(),
                         View<Unchanged<const Position>>(world, time).count());
    };
    EXPECT_EQ(counts(), std::pair(0u, 4001u));
    world.advanceFrame();
    world.write<Position>(far)->x = 7;
    EXPECT_EQ(counts(), std::pair(1u, 4000u)) << "the other archetype's chunks were left alone";
    Lookup<const Position> positions(world, time);
    EXPECT_TRUE(positions.changed(far));
    world.destroy(far);
    EXPECT_FALSE(positions.changed(far));
}

// What a flush makes is new once to each system, whether it stands before the flush or after it.
TEST(Schedule, WhatAFlushMakesIsNewOnce) {
    World world;
    JobRunner one(1);
    uint32_t before = 0, after = 0, makes = 1;
    Schedule s;
    s.add("before", [&](View<Changed<const Health>> fresh) { before += fresh.count(); });
    s.add("make", [&](Commands& commands) {
        for (; makes > 0; --makes)
            commands.create(Health{});
    });
    s.flush();
    s.add("after", [&](View<Changed<const Health>> fresh) { after += fresh.count(); });
    for (int frame = 0; frame < 4; ++frame)
        s.run(world, one);
    EXPECT_EQ(before, 1u);
    EXPECT_EQ(after, 1u);
    world.create(Health{}, Position{});  // between frames
    for (int frame = 0; frame < 3; ++frame)
        s.run(world, one);
    EXPECT_EQ(before, 2u);
    EXPECT_EQ(after, 2u);
}

// Sums whose order matters: equal bits for any number of threads.
TEST(Loops, FoldsDoNotDependOnThreads) {
    World world;
    for (int i = 0; i < 30000; ++i) {
        if (i % 3)
            world.create(Position{1.0f / float(i + 1), float(i), 0});
        else
            world.create(Position{float(i) * 1e-3f, 1, 2}, Health{i});
    }
    const auto sum = [&](uint32_t threads) {
        JobRunner runner(threads);
        LoopCost dear{.nsPerRow = 1000};  // worth splitting from the first time on
        return View<const Position>(world, {.version = 9, .lastRun = 0, .cost = &dear})
            .fold(
                runner, Position{},
                [](Position& all, const Position& p) { all.x += p.x, all.y += p.y * p.x, all.z += 1; },
                [](Position& all, const Position& part) {
                    all.x += part.x, all.y += part.y, all.z += part.z;
                });
    };
    const Position one = sum(1);
    EXPECT_EQ(one.z, 30000);
    EXPECT_GT(one.x, 1);
    for (const uint32_t threads : {2u, 4u})
        EXPECT_EQ(sum(threads), one);
}

TEST(Loops, ParallelCommandsArePlayedInTheOrderOfRows) {
    const auto simulate = [](uint32_t threads) {
        World world;
        for (int i = 0; i < 20000; ++i)
            world.create(Health{i});
        Schedule s;
        s.add("bury", [](View<Health> all, Commands& commands, JobRunner& runner) {
            all.parallel(runner, commands, [](Commands& later, Entity e, Health& h) {
                h.points -= 700;
                if (h.points >= 0) return;
                later.destroy(e);
                later.create(Health{h.points + 25000}, Position{float(e.index), 0, 0});
                if (h.points % 2) later.create(Velocity{});
            });
        });
        JobRunner runner(threads);
        for (int frame = 0; frame < 40; ++frame)
            s.run(world, runner);
        EXPECT_GT(world.entityCount(), 20000u);
        return world.stateHash();
    };
    const uint64_t serial = simulate(1);
    EXPECT_EQ(simulate(2), serial);
    EXPECT_EQ(simulate(4), serial);
}

TEST(Loops, ParallelLoopsMarkTheRowsTheyChanged) {
    World world;
    for (int i = 0; i < 20000; ++i)
        world.create(Streamed{float(i)});
    JobRunner runner(4);
    const auto takenSum = [&] {
        std::atomic<uint64_t> sum{0}, rows{0};
        LoopCost dear{.nsPerRow = 1000};
        View<Taken<const Streamed>>(world, {.version = 1, .lastRun = 0, .cost = &dear})
            .parallel(runner, [&](const Streamed& s) { sum += uint64_t(s.value), ++rows; });
        return std::pair(rows.load(), sum.load());
    };
    EXPECT_EQ(takenSum().first, 20000u);
    LoopCost dear{.nsPerRow = 1000};
    View<Streamed>(world, {.version = 3000, .lastRun = 0, .cost = &dear}).parallel(runner, [](Streamed& s) {
        return uint32_t(s.value) % 1000 == 7;
    });
    EXPECT_EQ(takenSum(), std::pair(uint64_t(20), uint64_t(20 * 7 + 1000 * 190)));
    EXPECT_EQ(takenSum().first, 0u);
}

// Two tracked components of the same rows have marks of their own, and writing while taking counts.
TEST(Loops, WhatIsWrittenWhileTakingIsMarked) {
    World world;
    std::vector<Entity> all;
    for (int i = 0; i < 3000; ++i)
        all.push_back(world.create(Streamed{float(i)}, Copied{}));
    SystemTime time{.version = world.version() + 1, .lastRun = 0};
    const auto rowsOf = [&](uint32_t lastRun) {
        std::vector<float> rows;
        View<Taken<const Copied>>(world, {.version = time.version + 1, .lastRun = lastRun})
            .each([&](const Copied& c) { rows.push_back(c.value); });
        return rows;
    };
    EXPECT_EQ(rowsOf(0).size(), 3000u);
    View<Taken<const Streamed>>(world, time).each([](const Streamed&) {});
    world.advanceFrame();
    for (const size_t i : {size_t(62), size_t(63), size_t(64), size_t(1500), size_t(2999)})
        world.write<Streamed>(all[i]);
    time = {.version = world.version() + 1, .lastRun = time.version};
    View<Taken<const Streamed>, Copied>(world, time).each([](const Streamed& s, Copied& c) {
        c.value = s.value;
    });
    EXPECT_EQ(rowsOf(time.version - 1), (std::vector<float>{62, 63, 64, 1500, 2999}));
    for (const size_t i : {size_t(400), size_t(401)})
        world.write<Streamed>(all[i]);
    world.advanceFrame();
    time = {.version = world.version() + 1, .lastRun = time.version};
    world.write<Streamed>(all[402]);
    View<Taken<const Streamed>, Copied>(world, time)
        .chunks([](std::span<const Streamed> s, std::span<Copied> c) {
            ASSERT_EQ(s.size(), 3u);
            for (size_t i = 0; i < c.size(); ++i)
                c[i].value = s[i].value;
        });
    EXPECT_EQ(rowsOf(time.version - 1), (std::vector<float>{400, 401, 402}));
}

using EcsDeathTest = testing::Test;
TEST(EcsDeathTest, TwoSystemsCannotTakeTheSameMarks) {
    testing::FLAGS_gtest_death_test_style = "threadsafe";
    Schedule s;
    s.add("first", [](View<Taken<const Streamed>>) {});
    EXPECT_DEATH(s.add("second", [](View<Taken<const Streamed>, const Health>) {}),
                 "first and second both take");
}

}  // namespace
}  // namespace ag
