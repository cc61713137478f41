// What the report says in words: what would make a frame faster, what its gaps wait for, what was made anew.
#include <gtest/gtest.h>

#include <algorithm>

#include "engine/capture/advice.h"
#include "engine/capture/gaps.h"
#include "engine/capture/levers.h"
#include "engine/capture/made_anew.h"
#include "engine/capture/report_findings.h"
#include "engine/core/settings.h"
#include "engine/renderer/frame_budget.h"
#include "tests/capture/seen.h"

namespace ag::capture {
namespace {

constexpr uint64_t kMs = 1'000'000;  // ns

Frame frameOf(std::initializer_list<std::pair<const char*, double>> passes) {
    Frame frame;
    uint64_t at = kMs;
    for (const auto& [name, ms] : passes) {
        const uint64_t end = at + uint64_t(ms * double(kMs));
        frame.gpu.push_back({name, at, end});
        at = end;
    }
    return frame;
}

const Advice* find(const std::vector<Advice>& advices, std::string_view setting) {
    for (const Advice& a : advices)
        if (a.assignment.starts_with(setting)) return &a;
    return nullptr;
}

double shareLeft(std::string_view setting, std::string_view technique) {
    const auto lever = std::ranges::find(levers(), setting, &Lever::setting);
    return std::ranges::find(lever->left, technique, &Remainder::technique)->share;
}

TEST(Advice, SavesOfTheFramesOwnTimes) {
    const Frame frame = frameOf({{"gbuffer.fill", 1}, {"val_shading.far", 6}, {"val_shading.near", 4}});
    const auto advices = adviceFor(frame, {});
    const Advice* spacing = find(advices, "gi.spacing=3");
    ASSERT_TRUE(spacing);
    EXPECT_EQ(spacing->from, "2");
    EXPECT_NEAR(spacing->savedMs, 10 * (1 - shareLeft("gi.spacing", "val_shading")), 1e-6);
    EXPECT_GT(spacing->errorTimes, 1.2);
    EXPECT_TRUE(std::ranges::is_sorted(advices, std::ranges::greater{}, &Advice::savedMs));
    for (const Advice& a : advices) {
        double sum = 0;
        for (const Saving& s : a.savings)
            sum += s.ms;
        EXPECT_NEAR(sum, a.savedMs, 1e-9);
        EXPECT_LT(a.savedMs, 11);
    }
}

TEST(Advice, HasNothingForWhatIsLowOrDidNotRun) {
    render::RenderSettings low;
    low.bounce.spacing = 4;
    EXPECT_FALSE(find(adviceFor(frameOf({{"val_shading.far", 5}}), low), "gi.spacing"));
    EXPECT_TRUE(adviceFor(frameOf({{"gbuffer.fill", 5}}), {}).empty());
    EXPECT_TRUE(fasterSteps(frameOf({{"gbuffer.fill", 5}}), {}).empty());
}

TEST(Advice, EverySettingThereIsAndCanBeSet) {
    render::RenderSettings gi;
    Settings settings;
    render::registerSettings(settings, gi);
    Frame frame;
    for (const Lever& lever : levers())
        for (const Remainder& left : lever.left)
            if (!left.technique.empty())
                frame.gpu.push_back({std::string(left.technique) + ".pass", 0, 10 * kMs});
    const auto advices = adviceFor(frame, gi);
    for (const Advice& a : advices)
        EXPECT_TRUE(settings.set(a.assignment)) << a.assignment;
    EXPECT_EQ(advices.size(), levers().size()) << "one of them names no setting";
}

TEST(Advice, StepsOfTheBudgetAreFasterAndWorse) {
    const Frame frame = frameOf({{"val_shading.far", 50}, {"ism_atlas.trace", 50}, {"gbuffer.fill", 10}});
    const auto steps = fasterSteps(frame, {});
    ASSERT_EQ(steps.size(), 2u);
    EXPECT_LT(steps[0].savedMs, steps[1].savedMs) << "the nearest first";
    EXPECT_LT(steps[1].savedMs, 100);
    for (const StepAdvice& s : steps)
        EXPECT_GT(s.errorTimes, 1);
    render::RenderSettings lowest;
    render::applyQualityStep(render::qualitySteps()[render::firstFullSizeStep()], lowest);
    EXPECT_TRUE(fasterSteps(frame, lowest).empty());
}

// Frames of 10 ms whose processor and device take turns.
std::vector<Frame> threeFrames() {
    std::vector<Frame> frames;
    for (uint64_t i = 0; i < 3; ++i) {
        const uint64_t at = 10 * kMs * (i + 1);
        Frame f{.number = 7 + i,
                .cpu = {.begin = at,
                        .waited = at,
                        .declared = at + kMs,
                        .recorded = at + 2 * kMs,
                        .submitted = at + 2 * kMs},
                .gpu = {{"gbuffer.fill", at + 2 * kMs, at + 6 * kMs},
                        {"composite.tonemap", at + 6 * kMs, at + 7 * kMs}}};
        frames.push_back(f);
    }
    return frames;
}

bool says(const std::vector<Gap>& gaps, std::string_view words) {
    return std::ranges::any_of(gaps, [&](const Gap& g) { return g.why.find(words) != std::string::npos; });
}

TEST(Gaps, OfTheDeviceUntilTheSubmission) {
    const auto gaps = gapsOf(threeFrames(), 1);
    ASSERT_EQ(gaps.size(), 2u);
    EXPECT_EQ(gaps[0].of, Gap::Of::kFrameLoop);
    EXPECT_TRUE(says(gaps, "8.00 ms went by between two frames"));
    EXPECT_EQ(gaps[1].endNs - gaps[1].beginNs, 5 * kMs);
    EXPECT_TRUE(says(
        gaps,
        "5.00 ms until frame 8 was submitted: the processor did other things than rendering for 3.00 ms"))
        << gaps[1].why;
}

TEST(Gaps, OfTheProcessorWaitingForTheFrameBeforeLast) {
    std::vector<Frame> frames = threeFrames();
    frames[2].cpu.waited += 900'000;
    frames[0].gpu.back().endNs = frames[2].cpu.begin + 900'000;
    const auto gaps = gapsOf(frames, 2);
    EXPECT_TRUE(says(gaps, "waited 0.90 ms for frame 7"));
    EXPECT_TRUE(says(gaps, "the device was still at it, last at composite.tonemap"));
}

TEST(Gaps, BetweenPassesAndOfTheDriver) {
    std::vector<Frame> frames = threeFrames();
    frames[1].gpu[1].beginNs += 700'000;
    EXPECT_TRUE(says(gapsOf(frames, 1), "0.70 ms between gbuffer.fill and composite.tonemap"));
    frames[1].cpu.recorded = frames[0].gpu.back().endNs + 100'000;
    EXPECT_TRUE(says(gapsOf(frames, 1), "its driver took 4.90 ms to begin"));
}

TEST(Gaps, NoneOfTheFirstFrameAndNoShortOnes) {
    EXPECT_TRUE(gapsOf(threeFrames(), 0).empty()) << "nothing is known before it";
    std::vector<Frame> frames = threeFrames();
    frames[1].gpu[1].beginNs += 40'000;
    EXPECT_FALSE(says(gapsOf(frames, 1), "between gbuffer.fill"));
}

PassDescription passOf(const char* name, PassReason cause, uint32_t changed, std::vector<uint32_t> writes) {
    PassDescription p{.name = name, .outcome = PassOutcome::kRan, .cause = cause, .changed = changed};
    p.writes = std::move(writes);
    return p;
}

TEST(MadeAnew, GoesBackToWhereItBegan) {
    FrameDescription frame;
    for (const char* name : {"scene.camera", "gbuffer.depth", "scene.materials", "composite.display"})
        frame.resources.push_back({.name = name});
    frame.passes = {passOf("scene.camera", PassReason::kParameters, ~0u, {0}),
                    passOf("gbuffer.fill", PassReason::kInput, 0, {1}),
                    passOf("gbuffer.sample", PassReason::kInput, 2, {}),
                    passOf("composite.tonemap", PassReason::kInput, 1, {3}),
                    passOf("exposure.adapt", PassReason::kHistory, 3, {})};
    frame.passes.front().uploads = true;
    frame.passes.push_back({.name = "rsm.render", .outcome = PassOutcome::kSkipped});
    EXPECT_EQ(madeAnew(frame),
              (std::vector<std::string>{"scene (1 pass): the camera moved.",
                                        "gbuffer (2 passes): the camera moved; materials changed.",
                                        "composite (1 pass): the camera moved.",
                                        "exposure (1 pass): it goes on from the frame before."}));
}

TEST(MadeAnew, OfARealWalkIsTheCamera) {
    const Frame& last = seen().frames.back();
    ASSERT_FALSE(last.madeAnew.empty());
    const auto of = [&](std::string_view technique) {
        const auto found =
            std::ranges::find_if(last.madeAnew, [&](const auto& s) { return s.starts_with(technique); });
        return found == last.madeAnew.end() ? std::string() : *found;
    };
    EXPECT_NE(of("gbuffer ").find("the camera moved"), std::string::npos) << of("gbuffer ");
    EXPECT_EQ(of("rsm "), "") << "the light stands still";
    const auto& forced = seen().frames[2].madeAnew;
    EXPECT_EQ(std::ranges::count_if(forced,
                                    [](const auto& t) {
                                        return t.starts_with("rsm (") &&
                                               t.ends_with("nothing is skipped in this frame.");
                                    }),
              1)
        << "the warm-up";
}

TEST(Findings, OfARealFrameNameItsDearestPasses) {
    const auto findings = findingsJson(seen(), seen().frames.size() - 1);
    EXPECT_FALSE(findings.at("advice").empty());
    for (const auto& sentence : findings.at("advice"))
        EXPECT_NE(std::string(sentence).find("saves about"), std::string::npos) << sentence;
}

}  // namespace
}  // namespace ag::capture
