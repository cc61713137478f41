// The choice of quality by time, against a model of what frames take.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "engine/renderer/frame_budget.h"

namespace ag::gi {
using namespace render;
namespace {

// A scene whose steps take other times than guessed, with noise.
struct Model {
    double mediumMs, skew;  // costs are the guesses to the power of `skew`
    double noise = 0;
    std::mt19937 random{5};
    double costOf(size_t step) {
        const double noisy = 1 + noise * (2 * double(random() >> 8) * 0x1p-24 - 1);
        return mediumMs * std::pow(qualitySteps()[step].relativeCost, skew) * noisy;
    }
};

struct Played {
    std::vector<double> ms;
    std::vector<size_t> steps;  // the one each frame was rendered with
    size_t changes(size_t from) const {
        size_t count = 0;
        for (size_t i = from + 1; i < steps.size(); ++i)
            count += steps[i] != steps[i - 1];
        return count;
    }
    double median(size_t from, size_t count) const {
        std::vector<double> part(ms.begin() + std::ptrdiff_t(from),
                                 ms.begin() + std::ptrdiff_t(from + count));
        std::ranges::sort(part);
        return part[part.size() / 2];
    }
};

// Times arrive three frames late, as timestamps do.
Played play(BudgetController& controller, Model& model, int frames, const Played* before = nullptr) {
    Played r = before ? *before : Played{};
    for (int i = 0; i < frames; ++i) {
        r.steps.push_back(controller.step());
        r.ms.push_back(model.costOf(controller.step()));
        controller.frame(r.ms.size() > 3 ? r.ms[r.ms.size() - 4] : 0);
    }
    return r;
}

TEST(FrameBudget, IsMetWithin120FramesWhateverTheSceneCosts) {
    for (const double medium : {3.0, 40.0, 160.0})
        for (const double skew : {0.8, 1.0, 1.25})
            for (const double share : {0.6, 0.8, 1.0, 1.7, 2.5, 4.0}) {
                Model model{medium, skew, 0.03};
                BudgetController controller(medium * share, firstFullSizeStep());
                const Played r = play(controller, model, 240);
                EXPECT_NEAR(r.median(90, 30) / (medium * share), 1, 0.1)
                    << medium << " " << skew << " " << share;
                EXPECT_EQ(r.changes(120), 0u)
                    << "it does not pump: " << medium << " " << skew << " " << share;
            }
}

// The first frames of a program tell what the device can do: it does not climb step by step.
TEST(FrameBudget, IsMetAtOnceAfterTheFirstFrames) {
    for (const double skew : {0.8, 1.0, 1.25}) {
        Model model{40, skew, 0.03};
        BudgetController controller(60, 0);
        EXPECT_FALSE(controller.chooseAtOnce()) << "nothing was seen yet";
        play(controller, model, 12);
        EXPECT_EQ(controller.step(), 0u);
        EXPECT_TRUE(controller.hasMeasured());
        EXPECT_TRUE(controller.chooseAtOnce());
        const double share = model.costOf(controller.step()) / 60;
        EXPECT_TRUE(share > 0.5 && share < 2) << share << ": as far as costs of steps are known";
        const Played r = play(controller, model, 60);
        EXPECT_NEAR(r.median(30, 30) / 60, 1, 0.1);
    }
}

// Something else has the device for five frames of thirty.
TEST(FrameBudget, FramesThatWereInterruptedDoNotCount) {
    for (const double share : {0.6, 1.0, 1.7, 4.0}) {
        Model model{40, 1, 0.03};
        BudgetController controller(40 * share, firstFullSizeStep());
        Played r;
        for (int i = 0; i < 240; ++i) {
            model.mediumMs = i % 30 < 5 ? 60 : 40;
            r = play(controller, model, 1, &r);
        }
        EXPECT_NEAR(r.median(90, 30) / (40 * share), 1, 0.1) << share;
        EXPECT_EQ(r.changes(120), 0u) << share;
    }
}

TEST(FrameBudget, ComesDownQuicklyAndUpSlowly) {
    Model model{50, 1};
    BudgetController controller(100, firstFullSizeStep());
    const Played calm = play(controller, model, 120);
    model.mediumMs = 100;  // all at once there is twice as much to do
    const Played busy = play(controller, model, 60, &calm);
    size_t late = 120;
    while (late < busy.ms.size() && busy.ms[late] > 110)
        ++late;
    EXPECT_LT(late, 120u + 16u) << "frames too long after the change";
    model.mediumMs = 50;
    const Played again = play(controller, model, 120, &busy);
    size_t up = 180;
    while (up < again.steps.size() && again.steps[up] == again.steps[179])
        ++up;
    EXPECT_GE(up, 180u + 12u);
    EXPECT_NEAR(double(again.steps.back()), double(calm.steps.back()), 1);
}

TEST(FrameBudget, StaysAtTheEndsOfTheLadder) {
    Model model{1000, 1};
    BudgetController slow(1, 0), fast(1e6, 0);
    EXPECT_EQ(play(slow, model, 100).steps.back(), 0u);
    EXPECT_EQ(play(fast, model, 100).steps.back(), qualitySteps().size() - 1);
    BudgetController untimed(10, 3);
    for (int i = 0; i < 100; ++i)
        EXPECT_FALSE(untimed.frame(0));
}

TEST(FrameBudget, StepsOfThePresetsAreThePresets) {
    for (const std::string_view name : {"low", "medium", "high", "ultra"}) {
        const size_t step = qualityStepNamed(name);
        ASSERT_LT(step, qualitySteps().size());
        RenderSettings chosen, preset;
        applyQualityStep(qualitySteps()[step], chosen);
        applyPreset(name, preset);
        EXPECT_EQ(chosen.bounce.rsm.resolution, preset.bounce.rsm.resolution) << name;
        EXPECT_EQ(chosen.bounce.valClustering.count, preset.bounce.valClustering.count) << name;
        EXPECT_EQ(chosen.bounce.ismAtlas.tileSize, preset.bounce.ismAtlas.tileSize) << name;
        EXPECT_EQ(chosen.bounce.ismAtlas.pointsPerMap, preset.bounce.ismAtlas.pointsPerMap) << name;
        EXPECT_EQ(chosen.bounce.spacing, preset.bounce.spacing) << name;
        EXPECT_EQ(chosen.bounce.valShading.nearReach, preset.bounce.valShading.nearReach) << name;
        EXPECT_EQ(chosen.bounce.valShading.taps, preset.bounce.valShading.taps) << name;
    }
}

// A frame in which most is skipped does not look cheap; what is no longer wanted costs nothing.
TEST(FrameBudget, CountsWhatWasSkipped) {
    FrameCost cost;
    const auto pass = [](std::string_view name, PassOutcome outcome, double ms) {
        return PassReport{.name = name, .outcome = outcome, .gpuMs = ms};
    };
    EXPECT_EQ(cost.add(std::array{pass("a", PassOutcome::kRan, 0)}), 0) << "not timed yet";
    EXPECT_EQ(cost.add(std::array{pass("a", PassOutcome::kRan, 3), pass("b", PassOutcome::kRan, 4)}), 7);
    EXPECT_EQ(cost.add(std::array{pass("a", PassOutcome::kSkipped, 0), pass("b", PassOutcome::kRan, 5)}), 8);
    EXPECT_EQ(cost.add(std::array{pass("a", PassOutcome::kSkipped, 0), pass("b", PassOutcome::kDropped, 0)}),
              3);
    EXPECT_EQ(cost.add(std::array{pass("a", PassOutcome::kRan, 1), pass("c", PassOutcome::kRan, 2)}, true), 5)
        << "where a part was done all of it is as before";
    EXPECT_EQ(cost.add(std::array{pass("a", PassOutcome::kRan, 1)}), 1);
}

}  // namespace
}  // namespace ag::gi
