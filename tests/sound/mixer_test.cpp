// The mixer: what comes out, mixed into memory, and that it opens and closes on a device that plays nothing.
#include "engine/sound/mixer.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace ag {
namespace {

const std::vector<Tone> kTones = {{.seconds = 0.25f, .partials = {{.frequency = 440, .decay = 2}}},
                                  {.seconds = 2, .partials = {{.frequency = 220, .decay = 9}}}};

// No test is heard, and none depends on the machine.
[[maybe_unused]] const int kNullDevice = setenv("ALSOFT_DRIVERS", "null", 1);

struct Heard {
    double left = 0, right = 0;  // root mean square
    double sum() const { return std::hypot(left, right); }
};

std::unique_ptr<Mixer> memoryMixer() {
    auto mixer = Mixer::openToMemory();
    EXPECT_TRUE(mixer) << mixer.error().message;
    (*mixer)->load(kTones);
    (*mixer)->listenAt({0, 0, 0}, {0, 0, -1});
    (*mixer)->setVolume(1);
    return std::move(*mixer);
}

Heard hear(Mixer& mixer, double seconds) {
    std::vector<float> samples(2 * size_t(seconds * kToneRate));
    mixer.mix(samples);
    Heard heard;
    for (size_t i = 0; i < samples.size(); i += 2) {
        heard.left += double(samples[i]) * double(samples[i]);
        heard.right += double(samples[i + 1]) * double(samples[i + 1]);
    }
    const double count = double(samples.size() / 2);
    return {std::sqrt(heard.left / count), std::sqrt(heard.right / count)};
}

TEST(Mixer, IsSilentUntilSomethingPlaysAndAfterwards) {
    const auto mixer = memoryMixer();
    EXPECT_EQ(hear(*mixer, 0.1).sum(), 0);
    mixer->play({.tone = 0});
    EXPECT_GT(hear(*mixer, 0.2).sum(), 0.05);
    hear(*mixer, 0.2);
    EXPECT_EQ(mixer->voicesPlaying(), 0u);
    EXPECT_LT(hear(*mixer, 0.1).sum(), 1e-6);
}

TEST(Mixer, SoundsComeFromTheirPlace) {
    const auto mixer = memoryMixer();
    mixer->play({.tone = 0, .placed = true, .position = {-3, 0, 0}});
    const Heard left = hear(*mixer, 0.3);
    EXPECT_GT(left.left, 2 * left.right);
    mixer->listenAt({0, 0, 0}, {0, 0, 1});  // turned round
    mixer->play({.tone = 0, .placed = true, .position = {-3, 0, 0}});
    const Heard turned = hear(*mixer, 0.3);
    EXPECT_GT(turned.right, 2 * turned.left);
}

TEST(Mixer, FarIsQuietAndFollowsTheListener) {
    const auto mixer = memoryMixer();
    mixer->play({.tone = 0, .placed = true, .position = {0, 0, -2}});
    const double near = hear(*mixer, 0.3).sum();
    mixer->play({.tone = 0, .placed = true, .position = {0, 0, -16}});
    const double far = hear(*mixer, 0.3).sum();
    EXPECT_NEAR(far / near, 2.0 / 16, 0.02);
    // A place that is far from the world's middle is as exact.
    mixer->listenAt({1e7, 0, 0}, {0, 0, -1});
    mixer->play({.tone = 0, .placed = true, .position = {1e7, 0, -2}});
    EXPECT_NEAR(hear(*mixer, 0.3).sum(), near, 0.02 * near);
    // While it plays, the listener walks away.
    mixer->play({.tone = 1, .placed = true, .position = {1e7, 0, -2}});
    const double before = hear(*mixer, 0.3).sum();
    mixer->listenAt({1e7, 0, 14}, {0, 0, -1});
    hear(*mixer, 0.1);
    EXPECT_LT(hear(*mixer, 0.3).sum(), 0.2 * before);
}

TEST(Mixer, VolumeAndGainCount) {
    const auto mixer = memoryMixer();
    mixer->play({.tone = 0});
    const double full = hear(*mixer, 0.3).sum();
    mixer->play({.tone = 0, .gain = 0.5f});
    EXPECT_NEAR(hear(*mixer, 0.3).sum() / full, 0.5, 0.02);
    mixer->setVolume(0.25f);
    hear(*mixer, 0.1);
    mixer->play({.tone = 0});
    EXPECT_NEAR(hear(*mixer, 0.3).sum() / full, 0.25, 0.02);
}

TEST(Mixer, SurroundingsFadeIntoEachOther) {
    auto opened = Mixer::openToMemory();
    ASSERT_TRUE(opened) << opened.error().message;
    const auto mixer = std::move(*opened);
    const Tone loop{.seconds = 0.5f, .peak = 0.3f, .partials = {{.frequency = 200}}};
    mixer->load(kTones, std::array{loop, loop});
    mixer->setVolume(1);
    EXPECT_EQ(hear(*mixer, 0.1).sum(), 0);
    mixer->surroundWith(0);
    mixer->fade(Mixer::kFadeSeconds / 2);
    hear(*mixer, 0.1);
    const double half = hear(*mixer, 0.5).sum();
    mixer->fade(Mixer::kFadeSeconds);
    hear(*mixer, 0.1);
    const double whole = hear(*mixer, 1.5).sum();
    EXPECT_NEAR(half / whole, 0.5, 0.03) << "and it goes on beyond its length";
    EXPECT_EQ(mixer->voicesPlaying(), 0u) << "sounds keep all voices";
    mixer->surroundWith(1);
    mixer->fade(2 * Mixer::kFadeSeconds);
    hear(*mixer, 0.1);
    EXPECT_NEAR(hear(*mixer, 0.5).sum() / whole, 1, 0.05) << "one instead of the other";
    mixer->surroundWith({});
    mixer->fade(Mixer::kFadeSeconds);
    hear(*mixer, 0.1);
    EXPECT_LT(hear(*mixer, 0.3).sum(), 1e-5);
}

TEST(Mixer, OnlyTheQuietestGiveWay) {
    const auto mixer = memoryMixer();
    for (uint32_t i = 0; i < kVoices; ++i)
        mixer->play({.tone = 1, .gain = 0.1f});
    EXPECT_EQ(mixer->voicesPlaying(), kVoices);
    const double crowd = hear(*mixer, 0.05).sum();
    for (int i = 0; i < 100; ++i)
        mixer->play({.tone = 1, .gain = 0.05f});
    EXPECT_LT(hear(*mixer, 0.05).sum(), 1.2 * crowd + 0.1) << "a quieter one changes nothing";
    mixer->play({.tone = 0, .gain = 1});
    EXPECT_EQ(mixer->voicesPlaying(), kVoices);
}

// On the device that plays nothing, which OpenAL has everywhere.
TEST(Mixer, OpensAndClosesADevice) {
    for (int i = 0; i < 3; ++i) {
        const auto mixer = Mixer::open();
        ASSERT_TRUE(mixer) << mixer.error().message;
        (*mixer)->load(kTones);
        (*mixer)->play({.tone = 0});
        EXPECT_EQ((*mixer)->voicesPlaying(), 1u);
    }
}

// OpenAL looks for its drivers once: in a program of its own.
TEST(MixerDeathTest, WithoutADeviceSaysSoInASentence) {
    testing::FLAGS_gtest_death_test_style = "threadsafe";
    EXPECT_EXIT(
        {
            setenv("ALSOFT_DRIVERS", "nosuchdriver", 1);
            const auto mixer = Mixer::open();
            std::fputs(mixer ? "a device" : mixer.error().message.c_str(), stderr);
            std::_Exit(0);
        },
        testing::ExitedWithCode(0), "^there is no sound device$");
}

}  // namespace
}  // namespace ag
