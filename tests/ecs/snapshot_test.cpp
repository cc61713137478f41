#include "engine/ecs/snapshot.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <random>

#include "engine/core/hash.h"
#include "engine/ecs/hierarchy.h"
#include "engine/ecs/schedule.h"
#include "tests/ecs/test_components.h"
#include "tests/support/own_folder.h"

namespace ag {
namespace {

void fill(World& world, int count) {
    std::mt19937 random(21);
    std::vector<Entity> all;
    for (int i = 0; i < count; ++i) {
        const Entity e = world.create(Position{float(i), 1, 2}, Health{int32_t(random() % 90)});
        if (i % 3 == 0) world.add(e, Velocity{0, float(i), 0});
        if (i % 5 == 0) world.add(e, Marked{});
        if (i % 7 == 0 && !all.empty()) world.add(e, Parent{all[random() % all.size()]});
        all.push_back(e);
        if (random() % 4 == 0) world.destroy(all[random() % all.size()]);
    }
}

void age(World& world, int frames) {
    Schedule s;
    s.add("age", [](View<Position, Health> all, Commands& commands) {
        all.each([&](Entity e, Position& p, Health& h) {
            p.y += p.x;
            if (--h.points > 0) return;
            commands.destroy(e);
            commands.create(Position{p.y, 0, 0}, Health{60}, Streamed{1});
        });
    });
    JobRunner one(1);
    for (int i = 0; i < frames; ++i)
        s.run(world, one);
}

TEST(Snapshot, RestoresEveryBit) {
    World world, back;
    fill(world, 5000);
    back.create(Health{5});  // is gone afterwards
    const std::vector<std::byte> saved = saveWorld(world);
    const Status restored = restoreWorld(back, saved);
    ASSERT_TRUE(restored) << restored.error().message;
    EXPECT_EQ(back.entityCount(), world.entityCount());
    EXPECT_EQ(back.stateHash(), world.stateHash());
    EXPECT_EQ(saveWorld(back), saved);
    int references = 0;
    View<const Parent>(world, {}).each([&](Entity e, const Parent& p) {
        ASSERT_NE(back.get<Parent>(e), nullptr);
        EXPECT_EQ(back.get<Parent>(e)->entity, p.entity);
        EXPECT_EQ(back.alive(p.entity), world.alive(p.entity)) << "references hold, dead ones stay dead";
        ++references;
    });
    EXPECT_GT(references, 100);
}

TEST(Snapshot, TheRestoredWorldGoesOnAsTheSavedOneDid) {
    World world, back;
    fill(world, 3000);
    age(world, 10);
    const std::vector<std::byte> saved = saveWorld(world);
    age(world, 50);
    ASSERT_TRUE(restoreWorld(back, saved));
    EXPECT_NE(back.stateHash(), world.stateHash());
    age(back, 50);
    EXPECT_EQ(back.stateHash(), world.stateHash()) << "rows and new handles in the same order";
    ASSERT_TRUE(restoreWorld(world, saved)) << "going back";
    age(world, 50);
    EXPECT_EQ(back.stateHash(), world.stateHash());
}

TEST(Snapshot, AfterRestoringEverythingCountsAsChanged) {
    World world;
    fill(world, 500);
    size_t seen = 0, taken = 0;
    Schedule s;
    s.add("see", [&](View<Changed<const Position>> changed) { seen = changed.count(); });
    s.add("take", [&](View<Taken<const Streamed>> changed) {
        taken = 0;
        changed.each([&](const Streamed&) { ++taken; });
    });
    JobRunner one(1);
    for (int i = 0; i < 70; ++i)
        world.create(Streamed{});
    const std::vector<std::byte> saved = saveWorld(world);
    for (int i = 0; i < 3; ++i)
        s.run(world, one);
    EXPECT_EQ(seen, 0u);
    EXPECT_EQ(taken, 0u);
    ASSERT_TRUE(restoreWorld(world, saved));
    s.run(world, one);
    EXPECT_EQ(seen, View<const Position>(world, {}).count());
    EXPECT_EQ(taken, 70u);
    s.run(world, one);
    EXPECT_EQ(seen, 0u);
}

std::string restoreError(World& world, std::span<const std::byte> bytes) {
    const Status status = restoreWorld(world, bytes);
    return status ? "" : status.error().message;
}

TEST(Snapshot, ForeignAndDamagedBytesLeaveTheWorldAsItWas) {
    World world, other;
    fill(world, 300);
    fill(other, 100);
    const uint64_t before = world.stateHash();
    const std::vector<std::byte> good = saveWorld(other);
    EXPECT_NE(restoreError(world, {}).find("not a saved world"), std::string::npos);
    const std::string text = "a text file, longer than a header would be, but no world at all";
    EXPECT_NE(restoreError(world, std::as_bytes(std::span(text))).find("not a saved world"),
              std::string::npos);
    std::mt19937 random(4);
    for (int i = 0; i < 300; ++i) {  // any bit, any cut
        std::vector<std::byte> bad = good;
        if (i % 2)
            bad[random() % bad.size()] ^= std::byte(1 << random() % 8);
        else
            bad.resize(random() % bad.size());
        ASSERT_NE(restoreError(world, bad), "") << i;
        ASSERT_EQ(world.stateHash(), before);
    }
}

void sign(std::vector<std::byte>& bytes) {
    const size_t body = bytes.size() - sizeof(uint64_t);
    const uint64_t hash = hashBytes(std::span(bytes).first(body));
    std::memcpy(bytes.data() + body, &hash, sizeof hash);
}

// A checksum keeps out accidents; what fits it but makes no sense is refused all the same.
TEST(Snapshot, NonsenseWithAGoodChecksumIsRefusedOrHarmless) {
    World other;
    fill(other, 60);
    const std::vector<std::byte> good = saveWorld(other);
    std::mt19937 random(5);
    int refused = 0;
    for (int i = 0; i < 3000; ++i) {
        std::vector<std::byte> bad = good;
        if (i % 3 == 0) bad.resize(21 + random() % (bad.size() - 21));
        bad[12 + random() % (bad.size() - 20)] = std::byte(random());
        sign(bad);
        World world;
        const Entity mine = world.create(Health{3});
        if (!restoreError(world, bad).empty()) {
            ++refused;
            ASSERT_EQ(world.entityCount(), 1u);
            ASSERT_EQ(world.get<Health>(mine)->points, 3);
            continue;
        }
        for (int k = 0; k < 40; ++k)  // a world that was taken can be worked with
            world.create(Health{k}, Position{});
    }
    EXPECT_GT(refused, 1000);
}

TEST(Snapshot, SaysWhichComponentDoesNotFit) {
    World world;
    world.create(Streamed{2});
    std::vector<std::byte> saved = saveWorld(world);
    const std::string name = "Streamed";
    const auto at = std::ranges::search(saved, std::as_bytes(std::span(name))).begin();
    ASSERT_NE(at, saved.end());
    std::vector<std::byte> renamed = saved, resized = saved;
    renamed[size_t(at - saved.begin())] = std::byte('B');
    sign(renamed);
    EXPECT_EQ(restoreError(world, renamed),
              "the saved world holds component Btreamed, which this program does not know");
    resized[size_t(at - saved.begin()) + name.size()] = std::byte(8);
    sign(resized);
    EXPECT_EQ(restoreError(world, resized),
              "component Streamed has 8 bytes in the saved world and 4 in this program");
    EXPECT_EQ(world.entityCount(), 1u);
}

TEST(Snapshot, SurvivesAFile) {
    World world, back;
    fill(world, 200);
    const std::string path = test::ownFile("a.world");
    ASSERT_TRUE(saveWorldFile(world, path));
    ASSERT_TRUE(loadWorldFile(back, path));
    EXPECT_EQ(back.stateHash(), world.stateHash());
    const Status missing = loadWorldFile(back, test::ownFile("none.world"));
    ASSERT_FALSE(missing);
    EXPECT_NE(missing.error().message.find("none.world"), std::string::npos);
    std::ofstream(path) << "hello";
    const Status foreign = loadWorldFile(back, path);
    ASSERT_FALSE(foreign);
    EXPECT_NE(foreign.error().message.find("a.world: the bytes are not a saved world"), std::string::npos);
    EXPECT_EQ(back.stateHash(), world.stateHash());
    EXPECT_FALSE(saveWorldFile(world, test::ownFile("no/such/folder.world")));
}

}  // namespace
}  // namespace ag
