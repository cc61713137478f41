// The level played whole, with its light.
#include <gtest/gtest.h>

#include <fstream>

#include "tests/play/stage/bot.h"
#include "tests/play/stage/reference_light.h"
#include "tests/support/device_environment.h"

namespace ag::game {
namespace {

constexpr uint32_t kTicksPerFrame = 12;

std::unique_ptr<Stage> playRecording(const std::string& path) {
    auto stage = std::make_unique<Stage>(test::device(), shippedLevel(), kTicksPerFrame);
    const auto inputs = loadReplay(path);
    EXPECT_TRUE(inputs) << inputs.error().message;
    for (const Input& input : *inputs)
        stage->tick(input);
    return stage;
}

std::unique_ptr<Stage> playWrong(const std::string& name) {
    return playRecording(AFTERGLOW_SOURCE_DIR "/tests/play/recordings/" + name + ".replay");
}

TEST(Walkthrough, OpensEveryFlowerAndEndsTheSameWayTwice) {
    const std::string path = AFTERGLOW_SOURCE_DIR "/game/level/walkthrough.replay";
    uint64_t hashes[2];
    for (uint64_t& hash : hashes) {
        const auto stage = playRecording(path);
        const Progress& p = stage->game.progress();
        EXPECT_EQ(p.flowers, 11u);
        EXPECT_EQ(p.flowersOpen, 11u);
        EXPECT_EQ(p.roomsSolved, 4u);
        EXPECT_TRUE(p.won);
        hash = stage->game.stateHash();
    }
    EXPECT_EQ(hashes[0], hashes[1]);
}

TEST(WrongRuns, TheDirectBeamOpensNothing) {
    const auto stage = playWrong("direct_beam");
    EXPECT_EQ(stage->flower(0).mood, FlowerMood::kBlinded);
    EXPECT_EQ(stage->flower(0).openness, 0);
    EXPECT_GT(stage->lightAt(0).direct.x, 1);
    EXPECT_EQ(stage->game.progress().flowersOpen, 0u);
}

TEST(WrongRuns, AnotherColourOpensNothing) {
    const auto stage = playWrong("wrong_colour");
    EXPECT_EQ(stage->flower(4).mood, FlowerMood::kWrong);
    EXPECT_FALSE(stage->flower(4).bloomed);
    EXPECT_GT(stage->lightAt(4).bounced.z, 2 * stage->lightAt(4).bounced.y)
        << "blue light on the green flower";
    EXPECT_EQ(stage->game.progress().roomsSolved, 1u);
}

TEST(WrongRuns, AWallBetweenOpensNothing) {
    const auto stage = playWrong("wall_between");
    EXPECT_EQ(stage->flower(1).openness, 0);
    EXPECT_LT(stage->lightAt(1).bounced.x, 0.02f) << "the light is on the other side of the screen";
    EXPECT_EQ(stage->lightAt(1).direct, glm::vec3(0));
    EXPECT_EQ(stage->game.progress().flowersOpen, 0u);
}

// Where the walkthrough lights a flower, its probe has what the path tracer has there.
TEST(Flowers, MeasureWhatThePathTracerMeasures) {
    Stage stage(test::device(), shippedLevel(), 4);
    stage.settings = {};  // as good as the renderer's default
    const glm::vec3 lampPlaces[] = {{-1.0f, 1.4f, -4.7f}, {2.9f, 1.4f, -5.0f}, {-2.6f, 1.4f, -14.2f}};
    const glm::vec3 lit[] = {{-4, 1.5f, -5.0f}, {4, 1.3f, -6.0f}, {-5, 1.5f, -14.4f}};
    for (size_t i = 0; i < 3; ++i) {
        const gi::ProbeLight measured = lightFlower(stage, i, lampPlaces[i], lit[i]);
        const glm::vec3 truth =
            referenceLight(stage.game.scene(), glm::vec3(stage.flowerAt(i) - stage.game.scene().originWorld));
        std::printf("flower %zu: %.4f %.4f %.4f, the path tracer %.4f %.4f %.4f\n", i, measured.bounced.x,
                    measured.bounced.y, measured.bounced.z, truth.x, truth.y, truth.z);
        EXPECT_NEAR(measured.bounced.x, truth.x, 0.1f * truth.x) << "flower " << i;
        EXPECT_LT(measured.direct.x, 0.02f);
    }
}

size_t residentKilobytes() {
    std::ifstream status("/proc/self/status");
    std::string word;
    while (status >> word)
        if (word == "VmRSS:") {
            size_t kilobytes = 0;
            status >> kilobytes;
            return kilobytes;
        }
    return 0;
}

// Ten thousand ticks of walking about, jumping, crouching and grasping.
TEST(Soak, TenThousandTicksNeedNoMoreMemory) {
    Stage stage(test::device(), shippedLevel(), 48);
    const auto input = [](int i) {
        return Input{.forward = i / 50 % 3 ? 1.0f : -1.0f,
                     .right = i / 70 % 2 ? 0.6f : 0,
                     .look = {float(i / 40 % 7) - 3, float(i % 11) - 5},
                     .buttons = uint32_t(i / 90 % 16)};
    };
    for (int i = 0; i < 3000; ++i)
        stage.tick(input(i));
    const size_t before = residentKilobytes();
    const uint64_t device = stage.renderer.deviceBytes();
    for (int i = 3000; i < 13000; ++i)
        stage.tick(input(i));
    EXPECT_LT(residentKilobytes(), before + 4096) << "kilobytes";
    EXPECT_EQ(stage.renderer.deviceBytes(), device);
    EXPECT_GT(stage.game.player().position.y, 0.5) << "still stands on the floor";
}

}  // namespace
}  // namespace ag::game
