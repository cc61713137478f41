// The level without a window or a device.
#include "game/game.h"

#include <gtest/gtest.h>

#include "engine/core/safe_file.h"
#include "engine/scene/extract_system.h"
#include "tests/game/level.h"
#include "tests/support/allocation_counter.h"
#include "tests/support/own_folder.h"
#include "tools/scenegen/scenes.h"

namespace ag::game {
namespace {

constexpr glm::uvec2 kSize(64, 36);

Input scripted(int tick) {
    return {.forward = tick % 90 < 60 ? 1.0f : -0.5f,
            .right = tick % 50 < 20 ? 0.7f : 0.0f,
            .look = {float(tick % 17) - 6, float(tick % 7) - 3},
            .buttons = tick % 40 > 30 ? uint32_t(kButtonLamp) : 0u};
}

SceneAsset hall() {
    return *scenegen::buildScene("hall", 0);
}

void step(Game& game, const Input& input) {
    game.tick(input);
    game.frame(kSize);
}

uint64_t play(uint32_t threads, int ticks) {
    Game game(level(), threads);
    for (int i = 0; i < ticks; ++i)
        step(game, scripted(i));
    return game.stateHash();
}

TEST(Game, SameInputsSameWorldOnAnyNumberOfThreads) {
    const uint64_t serial = play(1, 300);
    EXPECT_EQ(play(1, 300), serial);
    EXPECT_EQ(play(2, 300), serial);
    EXPECT_NE(play(1, 301), serial);
}

TEST(Game, ScheduleOrdersWhatConflicts) {
    Schedule tick = makeTickSchedule(), frame = makeFrameSchedule();
    EXPECT_TRUE(tick.ordered("readProbes", "growFlowers"));
    EXPECT_TRUE(tick.ordered("growFlowers", "judgeRooms"));
    EXPECT_TRUE(tick.ordered("judgeRooms", "openDoors"));
    EXPECT_TRUE(tick.ordered("openDoors", "stepPhysics")) << "doors are where bodies meet them";
    EXPECT_TRUE(tick.ordered("walkPlayer", "carryCrates"));
    EXPECT_TRUE(tick.ordered("walkPlayer", "aimLamp"));
    EXPECT_FALSE(tick.ordered("wakeLanterns", "openDoors"));
    EXPECT_TRUE(frame.ordered("placeBodies", "updateRootTransforms"));
    EXPECT_TRUE(frame.ordered("updateRootTransforms", "extractScene"));
    EXPECT_TRUE(frame.ordered("extractScene", "extractProbes"));
}

TEST(Game, ThePlayerStaysInTheRoomAndOutOfTheBoxes) {
    Game game(hall(), 1);
    for (int i = 0; i < 2000; ++i) {
        step(game, scripted(i * 7));
        const glm::dvec3 at = game.player().position;
        ASSERT_LT(std::abs(at.x), 6.0);
        ASSERT_LT(std::abs(at.z), 4.0);
        ASSERT_GT(at.y, 0.5);
        // The nearest of the columns, half a metre wide.
        for (const double x : {-3.0, 0.0, 3.0})
            for (const double z : {-2.2, 2.2})
                ASSERT_GT(std::max(std::abs(at.x - x), std::abs(at.z - z)), 0.25) << "tick " << i;
    }
}

TEST(Game, OnlyWhatMovedIsStreamed) {
    Game game(hall(), 1);
    step(game, {});
    EXPECT_TRUE(game.scene().allInstancesChanged) << "everything is new at first";
    const uint64_t lights = game.scene().lightsVersion;
    step(game, {});
    EXPECT_FALSE(game.scene().allInstancesChanged);
    uint32_t rows = 0;
    for (const auto& range : game.scene().changedInstances)
        rows += range.end - range.begin;
    EXPECT_EQ(rows, 3u) << "the slider, the spinner and the lift";
    for (int i = 0; i < 60; ++i)  // until the player stands on the floor
        step(game, {});
    const uint64_t stands = game.scene().lightsVersion;
    step(game, {});
    EXPECT_EQ(game.scene().lightsVersion, stands) << "the lamp is held still";
    const uint64_t camera = game.scene().cameraVersion;
    step(game, {.look = {10, 0}});
    EXPECT_GT(game.scene().cameraVersion, camera);
    EXPECT_GT(game.scene().lightsVersion, lights);
}

TEST(Game, TheOriginFollowsAFarCamera) {
    SceneAsset far = hall();
    for (SceneNode& node : far.nodes)
        node.local.translation += glm::dvec3(1e6, 0, -3e5);
    Game near(hall(), 1), away(std::move(far), 1);
    step(near, {});
    step(away, {});
    const glm::dvec3 a = near.scene().originWorld, b = away.scene().originWorld;
    EXPECT_LT(glm::length(b - glm::dvec3(1e6, 0, -3e5)), 2000);
    ASSERT_EQ(near.scene().instances.size(), away.scene().instances.size());
    for (size_t i = 0; i < near.scene().instances.size(); ++i) {
        const glm::dvec3 p = glm::dvec3(near.scene().instances[i].worldFromLocal[3]) + a;
        const glm::dvec3 q =
            glm::dvec3(away.scene().instances[i].worldFromLocal[3]) + b - glm::dvec3(1e6, 0, -3e5);
        EXPECT_LT(glm::length(p - q), 1e-3);
    }
}

TEST(Game, ASteadyTickAllocatesNothing) {
    Game game(level(), 1);
    for (int i = 0; i < 50; ++i)
        step(game, scripted(i));
    const size_t allocations = test::countAllocations([&] {
        for (int i = 50; i < 80; ++i)
            step(game, scripted(i));
    });
    EXPECT_EQ(allocations, 0u);
}

TEST(Replay, SurvivesAFileAndRefusesABrokenOne) {
    const std::string path = test::ownFile("a.replay");
    std::vector<Input> ticks;
    for (int i = 0; i < 50; ++i)
        ticks.push_back(scripted(i));
    const ReplayNotes notes = {{"device", "a card\nof two lines"}, {"quality", ""}};
    ASSERT_TRUE(saveReplay({ticks, notes}, path));
    const auto back = loadReplay(path);
    ASSERT_TRUE(back) << back.error().message;
    ASSERT_EQ(back->ticks.size(), ticks.size());
    for (size_t i = 0; i < ticks.size(); ++i) {
        EXPECT_EQ(back->ticks[i].look, ticks[i].look);
        EXPECT_EQ(back->ticks[i].forward, ticks[i].forward);
    }
    EXPECT_EQ(back->notes, (ReplayNotes{{"device", "a card of two lines"}, {"quality", ""}}));
    const std::string head = "afterglow replay 3\n";
    for (const std::string& text :
         {std::string(), std::string("hello\n"), head, head + "1 1 0 0 0\nend 1\n",
          head + "1 9 0 0 0 0\nend 1\n", head + "1 0 0 nan 0 0\nend 1\n", head + "1 0 0 0 0 0\nend 2\n",
          head + "0 0 0 0 0 0\nend 0\n", head + "99999999 0 0 0 0 0\nend 99999999\n",
          head + "1 0 0 0 0 99\nend 1\n", head + "1 0 0 0 0 0\n", head + "note\nend 0\n",
          head + "note No text\nend 0\n", head + "1 0 0 0 0 0\nnote late text\nend 1\n"}) {
        ASSERT_TRUE(writeFileSafely(path, text));
        const auto broken = loadReplay(path);
        ASSERT_FALSE(broken) << text;
        EXPECT_NE(broken.error().message.find("a.replay"), std::string::npos);
    }
}

// Thousands of lamps as entities: some flicker, some go off, some swing; the same on any number of threads.
TEST(Game, LampsFlickerSwingAndGoOut) {
    const SceneAsset hall = *scenegen::buildScene("lamps", 2048);
    Game a(hall, 1), b(hall, 2);
    step(a, {});
    step(b, {});
    const std::vector<RenderLight> before = a.scene().lights;
    for (int i = 0; i < 240; ++i) {
        step(a, {});
        step(b, {});
    }
    const std::vector<RenderLight>& lights = a.scene().lights;
    EXPECT_EQ(lights, b.scene().lights);
    ASSERT_EQ(lights.size(), before.size());
    size_t changed = 0, out = 0, moved = 0;
    for (size_t i = 0; i < lights.size(); ++i) {
        out += lights[i].intensity == glm::vec3(0);
        changed += lights[i].intensity != before[i].intensity;
        moved += lights[i].position != before[i].position;
    }
    EXPECT_GT(changed, lights.size() / 4);
    EXPECT_LT(changed, lights.size() / 2);
    EXPECT_GT(out, lights.size() / 100);
    EXPECT_GT(moved, lights.size() / 10);
}

}  // namespace
}  // namespace ag::game
