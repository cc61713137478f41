// The level played whole, with its light.
#include <gtest/gtest.h>

#include "tests/play/stage/bot.h"
#include "tests/support/device_environment.h"

namespace ag::game {
namespace {

struct Outcome {
    Progress progress;
    uint64_t hash = 0;
};

// A recording, played from the start.
Outcome playRecording(const std::string& path, uint32_t ticksPerFrame) {
    Stage stage(test::device(), shippedLevel(), ticksPerFrame);
    const auto inputs = loadReplay(path);
    EXPECT_TRUE(inputs) << inputs.error().message;
    for (const Input& input : *inputs)
        stage.tick(input);
    return {stage.game.progress(), stage.game.stateHash()};
}

TEST(Walkthrough, OpensEveryFlowerAndEndsTheSameWayTwice) {
    const std::string path = AFTERGLOW_SOURCE_DIR "/game/level/walkthrough.replay";
    const Outcome once = playRecording(path, 12), again = playRecording(path, 12);
    EXPECT_EQ(once.progress.flowers, 11u);
    EXPECT_EQ(once.progress.flowersOpen, 11u);
    EXPECT_EQ(once.progress.roomsSolved, 4u);
    EXPECT_TRUE(once.progress.won);
    EXPECT_EQ(once.hash, again.hash);
}

}  // namespace
}  // namespace ag::game
