// What the profiler keeps of frames: their techniques' times, and those that stood out.
#include "engine/app/pass_history.h"

#include <gtest/gtest.h>

#include <array>

namespace ag {
namespace {

// Two passes of one technique, 1 and 2 ms, and one of another.
void addFrame(PassHistory& history, uint64_t frame, uint64_t otherMs, double budgetMs = 10) {
    const std::array<PassSpan, 3> passes = {{{"rsm.render", 0, 1'000'000},
                                             {"rsm.build_texels", 1'000'000, 3'000'000},
                                             {"gbuffer.fill", 4'000'000, 4'000'000 + otherMs * 1'000'000}}};
    history.add({frame, passes, 1.0}, budgetMs);
}

TEST(PassHistory, SumsTechniques) {
    PassHistory history;
    addFrame(history, 1, 4);
    ASSERT_EQ(history.techniques(), (std::vector<std::string>{"rsm", "gbuffer"}));
    ASSERT_EQ(history.frames().size(), 1u);
    EXPECT_NEAR(history.frames()[0].ms, 7, 1e-9);
    EXPECT_FLOAT_EQ(history.frames()[0].techniques[0], 3);
    EXPECT_FLOAT_EQ(history.frames()[0].techniques[1], 4);
    EXPECT_EQ(history.frames()[0].worst, "gbuffer.fill");
}

TEST(PassHistory, CountsAFrameOnceAndForgetsOldOnes) {
    PassHistory history;
    history.add({}, 10);
    EXPECT_TRUE(history.frames().empty()) << "no frame's times are there yet";
    for (uint64_t frame = 1; frame <= 2 * PassHistory::kFrames; ++frame) {
        addFrame(history, frame, 4);
        addFrame(history, frame, 4);
    }
    EXPECT_EQ(history.frames().size(), PassHistory::kFrames);
    EXPECT_EQ(history.frames().back().frame, 2 * PassHistory::kFrames);
    EXPECT_NEAR(history.medianMs(), 7, 1e-6);
    EXPECT_NEAR(history.medianMs(0), 3, 1e-6);
}

TEST(PassHistory, KeepsSpikesWhenTheirFramesAreGone) {
    PassHistory history;
    uint64_t frame = 0;
    const auto usual = [&](size_t count) {
        for (size_t i = 0; i < count; ++i)
            addFrame(history, ++frame, 4);
    };
    usual(20);
    addFrame(history, ++frame, 40);
    const uint64_t spike = frame;
    addFrame(history, ++frame, 6);  // 9 ms: unusual, but within the budget
    usual(2 * PassHistory::kFrames);
    ASSERT_EQ(history.spikes().size(), 1u);
    EXPECT_EQ(history.spikes()[0].frame, spike);
    EXPECT_NEAR(history.spikes()[0].ms, 43, 1e-6);
    EXPECT_EQ(history.spikes()[0].worst, "gbuffer.fill");
    for (uint64_t ms = 30; ms < 50; ++ms) {
        addFrame(history, ++frame, ms);
        usual(1);
    }
    ASSERT_EQ(history.spikes().size(), PassHistory::kSpikes);
    EXPECT_NEAR(history.spikes().front().ms, 52, 1e-6) << "longest first";
    history.forgetSpikes();
    EXPECT_TRUE(history.spikes().empty());
}

TEST(PassHistory, ASlowDeviceAloneIsNoSpike) {
    PassHistory history;
    for (uint64_t frame = 1; frame <= 100; ++frame)
        addFrame(history, frame, 40);
    EXPECT_TRUE(history.spikes().empty()) << "all are over the budget, none stands out";
}

}  // namespace
}  // namespace ag
