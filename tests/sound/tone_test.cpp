// Tones: their length, loudness, ends and pitch.
#include "engine/sound/tone.h"

#include <gtest/gtest.h>

#include <cmath>
#include <span>

namespace ag {
namespace {

// Hz, by how often the wave goes up through zero.
double pitchOf(std::span<const float> samples) {
    size_t first = 0, last = 0, crossings = 0;
    for (size_t i = 1; i < samples.size(); ++i) {
        if (samples[i - 1] >= 0 || samples[i] < 0) continue;
        if (crossings++ == 0) first = i;
        last = i;
    }
    return crossings < 2 ? 0 : double(crossings - 1) * kToneRate / double(last - first);
}

float peakOf(std::span<const float> samples) {
    float most = 0;
    for (const float s : samples)
        most = std::max(most, std::abs(s));
    return most;
}

TEST(Tone, HasItsLengthAndItsPeakAndEndsInSilence) {
    const Tone tone{.seconds = 0.5f,
                    .peak = 0.6f,
                    .partials = {{.frequency = 300}, {.frequency = 700, .gain = 3, .delay = 0.1f}}};
    const std::vector<float> samples = renderTone(tone);
    EXPECT_EQ(samples.size(), size_t(kToneRate / 2));
    EXPECT_NEAR(peakOf(samples), 0.6f, 1e-5f);
    EXPECT_EQ(samples.front(), 0);
    EXPECT_EQ(samples.back(), 0);
    EXPECT_EQ(renderTone(tone), samples);
}

TEST(Tone, SoundsAtItsPitch) {
    for (const float frequency : {65.0f, 440.0f, 1046.5f}) {
        const auto samples = renderTone({.partials = {{.frequency = frequency, .decay = 3}}});
        EXPECT_NEAR(pitchOf(samples), double(frequency), 0.005 * double(frequency));
    }
}

TEST(Tone, GlidesEvenlyInPitch) {
    const auto samples = renderTone({.partials = {{.frequency = 200, .glideTo = 800, .decay = 5}}});
    const std::span<const float> all(samples);
    const size_t part = 2000, middle = all.size() / 2 - part / 2;
    EXPECT_NEAR(pitchOf(all.first(part)), 206, 12);
    EXPECT_NEAR(pitchOf(all.subspan(middle, part)), 400, 16);
    EXPECT_NEAR(pitchOf(all.subspan(all.size() - part - 900, part)), 760, 30);
}

TEST(Tone, DiesAwayAsItSays) {
    const auto samples = renderTone({.seconds = 1, .partials = {{.frequency = 440, .decay = 0.5f}}});
    const std::span<const float> all(samples);
    const float early = peakOf(all.subspan(kToneRate / 10, 500)),
                late = peakOf(all.subspan(kToneRate / 2, 500));
    EXPECT_NEAR(late / early, std::pow(0.001f, 0.8f), 0.0004f) << "0.4 s of the 0.5 s to a thousandth";
}

// Where it begins again there is no step, and no quieter place.
TEST(Tone, ALoopHasNoSeam) {
    const Tone tone{
        .seconds = 1.3f,
        .peak = 0.5f,
        .partials = {{.frequency = 500, .kind = PartialKind::kNoise}, {.frequency = 151, .gain = 0.1f}}};
    const std::vector<float> samples = renderLoop(tone);
    ASSERT_EQ(samples.size(), size_t(1.3f * float(kToneRate)));
    EXPECT_NEAR(peakOf(samples), 0.5f, 1e-5f);
    float step = 0;
    for (size_t i = 1; i < samples.size(); ++i)
        step = std::max(step, std::abs(samples[i] - samples[i - 1]));
    EXPECT_LE(std::abs(samples.front() - samples.back()), step);
    const auto power = [&](size_t part) {
        double sum = 0;
        for (size_t i = part * samples.size() / 4; i < (part + 1) * samples.size() / 4; ++i)
            sum += double(samples[i]) * double(samples[i]);
        return sum;
    };
    EXPECT_NEAR(power(0) / ((power(1) + power(2) + power(3)) / 3), 1, 0.25);
    // Whole periods: the sine alone goes on as if it had never ended.
    const std::vector<float> sine = renderLoop({.seconds = 0.5f, .partials = {{.frequency = 151}}});
    EXPECT_NEAR(pitchOf(sine), 152, 1.5);
    EXPECT_NEAR(sine.front() - sine.back(), sine[1] - sine[0], 1e-3f);
}

TEST(Tone, NoiseIsSoft) {
    const auto samples = renderTone(
        {.seconds = 0.4f, .partials = {{.frequency = 500, .decay = 1, .kind = PartialKind::kNoise}}});
    EXPECT_LT(pitchOf(samples), 900);
    float jump = 0;
    for (size_t i = 1; i < samples.size(); ++i)
        jump = std::max(jump, std::abs(samples[i] - samples[i - 1]));
    EXPECT_LT(jump, 0.25f);
}

}  // namespace
}  // namespace ag
