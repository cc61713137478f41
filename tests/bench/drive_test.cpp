// The longest frames of a drive, and what they are put down to; the way through a scene's cameras.
#include <gtest/gtest.h>

#include "tools/bench/long_frames.h"
#include "tools/scenegen/scenes.h"

namespace ag::bench {
namespace {

TEST(Drive, NamesWhatMadeAFrameLong) {
    DriveReport report;
    LongFrames steps;
    for (uint32_t i = 0; i < 40; ++i) {
        FrameCost cost{.whole = 20 + 0.01 * i, .world = 1, .extract = 2, .render = 3};
        if (i == 7) cost.whole += 30, cost.extract += 30;
        if (i == 9) cost.whole += 10, cost.world += 10;
        report.frames.push_back(cost);
        steps.note(cost);
    }
    steps.finish(report);
    ASSERT_EQ(report.longest.size(), 10u);
    EXPECT_EQ(report.longest[0].frame, 7u);
    EXPECT_EQ(report.longest[0].culprits.front().step, "CPU: extraction");
    EXPECT_NEAR(report.longest[0].culprits.front().excess, 30, 1e-9);
    EXPECT_EQ(report.longest[1].frame, 9u);
    EXPECT_EQ(report.longest[1].culprits.front().step, "CPU: world");
    EXPECT_EQ(report.longest[2].frame, 39u);
    const Spread whole = report.of(&FrameCost::whole);
    EXPECT_NEAR(whole.median, 20.2, 0.02);
    EXPECT_NEAR(whole.worst, 50.07, 1e-9);
    EXPECT_NE(driveToJson(report).find("CPU: extraction"), std::string::npos);
}

TEST(Drive, PassesTheCamerasInTurnAndComesBack) {
    const SceneAsset asset = *scenegen::buildScene("town", 8);
    const DrivePath path(asset);
    const size_t stops = asset.cameras.size();
    for (size_t i = 0; i <= stops; ++i) {
        const CameraPose stop = cameraOf(asset, i % stops), pose = path.at(double(i) / double(stops));
        EXPECT_LT(glm::distance(pose.position, stop.position), 1e-6) << i;
        EXPECT_GT(glm::dot(pose.forward, stop.forward), 0.9999f) << i;
    }
    double longest = 0;
    for (int i = 0; i < 2000; ++i)
        longest = std::max(longest,
                           glm::distance(path.at(i / 2000.0).position, path.at((i + 1) / 2000.0).position));
    EXPECT_LT(longest, 1) << "no leaps";
    const SceneAsset room = *scenegen::buildScene("cornell", 0);
    EXPECT_EQ(DrivePath(room).at(0).position, cameraOf(room, 0).position);
    EXPECT_NE(DrivePath(room).at(0.5).position, cameraOf(room, 0).position);
}

TEST(Town, IsASquareKilometreOfThings) {
    const SceneAsset asset = *scenegen::resolveScene("town:2000", 0);
    const RenderScene scene = staticScene(asset);
    const glm::vec3 size = scene.bounds.max - scene.bounds.min;
    EXPECT_NEAR(size.x, 1000, 20);
    EXPECT_NEAR(size.z, 1000, 20);
    EXPECT_LT(size.y, 20);
    size_t still = 0, moving = 0;
    for (const SceneNode& node : asset.nodes) {
        still += node.mesh >= 0 && node.extras.movePeriod == 0;
        moving += node.mesh >= 0 && node.extras.movePeriod > 0;
    }
    EXPECT_GE(still, 10'000u);
    EXPECT_EQ(moving, 2000u);
    EXPECT_EQ(asset.lights.size(), 501u);
    EXPECT_TRUE(asset.sky);
    EXPECT_FALSE(scenegen::resolveScene("town:many", 0)) << "no number, no file";
}

}  // namespace
}  // namespace ag::bench
