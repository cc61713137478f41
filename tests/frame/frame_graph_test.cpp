// The graph's decisions, without a device.
#include "engine/frame/frame_description.h"
#include "tests/frame/kilobyte.h"

#include <gtest/gtest.h>

#include <map>
#include <string>

namespace ag {
namespace {

constexpr ImageInfo kImage{.format = VK_FORMAT_R16G16B16A16_SFLOAT, .size = {64, 64}};
constexpr ImageInfo kScratchImage{
    .format = VK_FORMAT_R16G16B16A16_SFLOAT, .size = {64, 64}, .lifetime = Lifetime::kScratch};

struct NullGraph : testing::Test {
    FrameGraph g{nullptr, nullptr};
    FrameGraphOptions options;

    std::map<std::string, PassOutcome> run() {
        g.execute(VK_NULL_HANDLE);
        std::map<std::string, PassOutcome> outcomes;
        for (const PassReport& pass : g.report())
            outcomes[std::string(pass.name)] = pass.outcome;
        return outcomes;
    }
    const PassRecord& record(std::string_view name) {
        for (const PassRecord& r : g.nullRecords())
            if (r.name == name) return r;
        ADD_FAILURE() << name << " did not run";
        static const PassRecord kNone;
        return kNone;
    }
};

// source -> a -> b, the output of the frame.
void declareChain(FrameGraph& g, uint64_t version, uint32_t pushA = 0) {
    const BufferHandle source = g.importBuffer("source", kBuffer, version);
    const BufferHandle a = g.buffer("a", kBuffer), b = g.buffer("b", kBuffer);
    g.compute("make.a", "a.comp").read("source", source).write("a", a).push(pushA).dispatchThreads(1);
    g.compute("make.b", "b.comp").read("a", a).write("b", b).dispatchThreads(1);
    g.output(b);
}

TEST_F(NullGraph, SaysWhyEachPassRanOrDidNot) {
    const auto declare = [&](uint64_t version, uint32_t push, uint64_t step, bool skip = true) {
        options.skip = skip;
        g.beginFrame(options);
        declareChain(g, version, push);
        const HistoryBuffer sum = g.historyBuffer("sum", kBuffer);
        g.compute("make.sum", "sum.comp").readPrevious("before", sum).write("sum", sum.current).step(step);
        g.output(sum.current);
        g.compute("make.unread", "a.comp").write("u", g.buffer("u", kBuffer)).dispatchThreads(1);
        g.execute(VK_NULL_HANDLE);
        std::string all;
        for (const PassReport& pass : g.report())
            all += std::string(pass.name) + " " + std::string(reasonText(pass.reason)) +
                   std::string(pass.changed) + "; ";
        return all;
    };
    const std::string unread = "make.unread nobody reads it; ", still = "nothing it reads changed; ";
    EXPECT_EQ(declare(1, 0, 1),
              "make.a for the first time; make.b for the first time; make.sum for the first time; " + unread);
    EXPECT_EQ(declare(1, 0, 1), "make.a " + still + "make.b " + still + "make.sum " + still + unread);
    EXPECT_EQ(declare(2, 0, 1), "make.a changed: source; make.b changed: a; make.sum " + still + unread);
    EXPECT_EQ(declare(2, 7, 1),
              "make.a its parameters changed; make.b changed: a; make.sum " + still + unread);
    EXPECT_EQ(declare(2, 7, 2),
              "make.a " + still + "make.b " + still + "make.sum its parameters changed; " + unread);
    EXPECT_EQ(declare(2, 7, 2, false),
              "make.a all are to run; make.b all are to run; make.sum all are to run; " + unread);
}

TEST_F(NullGraph, SkipsWhatDidNotChange) {
    for (int frame = 0; frame < 5; ++frame) {
        g.beginFrame(options);
        declareChain(g, 1);
        const auto outcome = run();
        const PassOutcome expected = frame == 0 ? PassOutcome::kRan : PassOutcome::kSkipped;
        EXPECT_EQ(outcome.at("make.a"), expected);
        EXPECT_EQ(outcome.at("make.b"), expected);
    }
    g.beginFrame(options);
    declareChain(g, 2);
    EXPECT_EQ(run().at("make.b"), PassOutcome::kRan) << "a changed import reaches the end";
    g.beginFrame(options);
    declareChain(g, 2, 7);
    EXPECT_EQ(run().at("make.a"), PassOutcome::kRan) << "changed push constants count";
}

TEST_F(NullGraph, SkipOffRunsAllThatIsNeeded) {
    options.skip = false;
    for (int frame = 0; frame < 3; ++frame) {
        g.beginFrame(options);
        declareChain(g, 1);
        g.compute("nobody.needs", "c.comp").write("c", g.buffer("c", kBuffer)).dispatchThreads(1);
        const auto outcome = run();
        EXPECT_EQ(outcome.at("make.a"), PassOutcome::kRan);
        EXPECT_EQ(outcome.at("make.b"), PassOutcome::kRan);
        EXPECT_EQ(outcome.at("nobody.needs"), PassOutcome::kDropped);
    }
}

TEST_F(NullGraph, DropsWhatNobodyReads) {
    g.beginFrame(options);
    declareChain(g, 1);
    const BufferHandle c = g.buffer("c", kBuffer), d = g.buffer("d", kBuffer);
    g.compute("make.c", "c.comp").write("c", c).dispatchThreads(1);
    g.compute("make.d", "d.comp").read("c", c).write("d", d).dispatchThreads(1);
    const auto outcome = run();
    EXPECT_EQ(outcome.at("make.c"), PassOutcome::kDropped);
    EXPECT_EQ(outcome.at("make.d"), PassOutcome::kDropped);
}

TEST_F(NullGraph, BarriersByKindOfUse) {
    g.beginFrame(options);
    const ImageHandle color = g.image("color", kImage), result = g.image("result", kImage);
    const BufferHandle buffer = g.buffer("buffer", kBuffer), second = g.buffer("second", kBuffer);
    g.fullscreen("draw", "draw.frag").colorClear(color, glm::vec4(0));
    g.compute("write", "write.comp").write("buffer", buffer).dispatchThreads(1);
    g.compute("first.read", "r.comp").read("buffer", buffer).write("second", second).dispatchThreads(1);
    g.compute("second.read", "s.comp")
        .read("buffer", buffer)
        .read("second", second)
        .sample("color", color)
        .write("result", result)
        .dispatchThreads(1);
    g.compute("overwrite", "o.comp").readWrite("buffer", buffer).dispatchThreads(1);
    g.output(result);
    g.output(buffer);
    run();

    ASSERT_EQ(record("draw").barriers.size(), 1u);
    EXPECT_EQ(record("draw").barriers[0].oldLayout, VK_IMAGE_LAYOUT_UNDEFINED);
    EXPECT_EQ(record("draw").barriers[0].newLayout, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
    EXPECT_TRUE(record("write").barriers.empty()) << "nothing came before";
    ASSERT_EQ(record("first.read").barriers.size(), 1u);
    EXPECT_EQ(record("first.read").barriers[0].resource, "buffer");
    EXPECT_EQ(record("first.read").barriers[0].srcAccess, VK_ACCESS_2_SHADER_WRITE_BIT);
    EXPECT_EQ(record("first.read").barriers[0].dstAccess,
              VK_ACCESS_2_SHADER_READ_BIT | VK_ACCESS_2_UNIFORM_READ_BIT);
    bool bufferAgain = false, colorSampled = false;
    for (const BarrierRecord& b : record("second.read").barriers) {
        bufferAgain |= b.resource == "buffer";
        colorSampled |= b.resource == "color" && b.oldLayout == VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL &&
                        b.newLayout == VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    }
    EXPECT_FALSE(bufferAgain) << "a read after a read needs no barrier";
    EXPECT_TRUE(colorSampled);
    ASSERT_EQ(record("overwrite").barriers.size(), 1u) << "a write waits for the reads before it";
    EXPECT_EQ(record("overwrite").barriers[0].resource, "buffer");
}

// clear -> add -> early reader -> add more -> late reader
void declareAccumulation(FrameGraph& g, uint64_t earlyVersion, uint64_t lateVersion) {
    const BufferHandle sum = g.buffer("sum", kBuffer), early = g.buffer("early", kBuffer),
                       late = g.buffer("late", kBuffer);
    const BufferHandle e = g.importBuffer("e", kBuffer, earlyVersion),
                       l = g.importBuffer("l", kBuffer, lateVersion);
    g.fill("clear", sum, 0);
    g.compute("add", "add.comp").readWrite("sum", sum).dispatchThreads(1);
    g.compute("early", "early.comp").read("sum", sum).read("e", e).write("early", early).dispatchThreads(1);
    g.compute("add.more", "more.comp").readWrite("sum", sum).dispatchThreads(1);
    g.compute("late", "late.comp").read("sum", sum).read("l", l).write("late", late).dispatchThreads(1);
    g.output(early);
    g.output(late);
}

TEST_F(NullGraph, ChainsOfWritesRunFromTheirStartWhenAnEarlyVersionIsNeeded) {
    g.beginFrame(options);
    declareAccumulation(g, 1, 1);
    for (const auto& [name, outcome] : run())
        EXPECT_EQ(outcome, PassOutcome::kRan) << name;

    g.beginFrame(options);
    declareAccumulation(g, 1, 2);
    auto outcome = run();
    EXPECT_EQ(outcome.at("late"), PassOutcome::kRan);
    EXPECT_EQ(outcome.at("add"), PassOutcome::kSkipped) << "the last version is still there";
    EXPECT_EQ(outcome.at("early"), PassOutcome::kSkipped);

    g.beginFrame(options);
    declareAccumulation(g, 2, 2);
    outcome = run();
    EXPECT_EQ(outcome.at("clear"), PassOutcome::kRan) << "the middle version is gone and is made again";
    EXPECT_EQ(outcome.at("add"), PassOutcome::kRan);
    EXPECT_EQ(outcome.at("early"), PassOutcome::kRan);
    EXPECT_EQ(outcome.at("late"), PassOutcome::kSkipped);

    g.beginFrame(options);
    declareAccumulation(g, 2, 3);
    outcome = run();
    EXPECT_EQ(outcome.at("clear"), PassOutcome::kRan) << "it was left at its middle version";
    EXPECT_EQ(outcome.at("add.more"), PassOutcome::kRan);
    EXPECT_EQ(outcome.at("late"), PassOutcome::kRan);
    EXPECT_EQ(outcome.at("early"), PassOutcome::kSkipped);
}

void declareHistory(FrameGraph& g, uint64_t version, uint64_t step) {
    const BufferHandle source = g.importBuffer("source", kBuffer, version);
    const HistoryBuffer h = g.historyBuffer("history", kBuffer);
    const BufferHandle out = g.buffer("out", kBuffer);
    g.compute("step", "step.comp")
        .read("source", source)
        .readPrevious("previous", h)
        .write("current", h.current)
        .step(step)
        .dispatchThreads(1);
    g.compute("use", "use.comp").read("current", h.current).write("out", out).dispatchThreads(1);
    g.output(out);
}

TEST_F(NullGraph, HistoriesStepOnlyWhenTheirInputsDo) {
    const auto frame = [&](uint64_t version, uint64_t step) {
        g.beginFrame(options);
        declareHistory(g, version, step);
        return run();
    };
    EXPECT_EQ(frame(1, 0).at("step"), PassOutcome::kRan);
    EXPECT_EQ(frame(1, 0).at("step"), PassOutcome::kSkipped);
    EXPECT_EQ(frame(1, 1).at("step"), PassOutcome::kRan) << "a step asked for";
    EXPECT_EQ(frame(1, 1).at("use"), PassOutcome::kSkipped);
    EXPECT_EQ(frame(2, 1).at("use"), PassOutcome::kRan);
    EXPECT_EQ(frame(1, 1).at("use"), PassOutcome::kRan)
        << "going back is a step too: the past is another one";
}

TEST_F(NullGraph, WhatIsHeldStaysThoughWhatItReadsChanges) {
    const auto frame = [&](uint64_t version, bool hold, bool skip) {
        options.skip = skip;
        g.beginFrame(options);
        const BufferHandle source = g.importBuffer("source", kBuffer, version);
        const HistoryBuffer sum = g.historyBuffer("sum", kBuffer);
        g.held(hold)
            .compute("held", "a.comp")
            .read("source", source)
            .readPrevious("before", sum)
            .write("sum", sum.current);
        const BufferHandle out = g.buffer("out", kBuffer);
        g.compute("use", "b.comp").read("sum", sum.current).read("source", source).write("out", out);
        g.output(out);
        return run();
    };
    for (const bool skip : {true, false}) {
        g.resetHistory("sum");
        EXPECT_EQ(frame(1, true, skip).at("held"), PassOutcome::kRan) << "there is nothing yet";
        const uint64_t ran = g.report().front().runCount;
        auto outcome = frame(2, true, skip);
        EXPECT_EQ(outcome.at("held"), PassOutcome::kSkipped);
        EXPECT_EQ(g.report().front().reason, PassReason::kHeld);
        EXPECT_EQ(outcome.at("use"), PassOutcome::kRan) << "of the rest it sees what changed";
        outcome = frame(2, true, skip);
        EXPECT_EQ(outcome.at("use"), skip ? PassOutcome::kSkipped : PassOutcome::kRan);
        EXPECT_EQ(frame(2, false, skip).at("held"), PassOutcome::kRan) << "what was put off comes";
        EXPECT_EQ(g.report().front().runCount, ran + 1);
    }
}

// A pass that goes on from its own past, and one that reads it.
HistoryBuffer declareSum(GraphScope scope, uint64_t version) {
    const HistoryBuffer sum = scope.historyBuffer("sum", kBuffer);
    scope.compute("step", "a.comp")
        .read("source", scope.importBuffer("source", kBuffer, version))
        .readPrevious("before", sum)
        .write("sum", sum.current);
    scope.output(sum.current);
    return sum;
}

TEST_F(NullGraph, ScopesShareNothingButTheFrame) {
    const GraphScope left = g.makeScope("left"), right = g.makeScope("right");
    bool leftValid = false, rightValid = false;
    const auto frame = [&](uint64_t leftVersion, uint64_t rightVersion) {
        g.beginFrame(options);
        leftValid = declareSum(left, leftVersion).valid;
        rightValid = declareSum(right, rightVersion).valid;
        EXPECT_NE(left.findBuffer("sum"), right.findBuffer("sum"));
        EXPECT_FALSE(g.findBuffer("sum")) << "the outermost scope has no such name";
        run();
        return std::pair(g.report()[0].outcome, g.report()[1].outcome);
    };
    using enum PassOutcome;
    EXPECT_EQ(frame(1, 1), std::pair(kRan, kRan));
    EXPECT_EQ(g.report()[0].name, "left/step");
    EXPECT_EQ(g.report()[1].name, "right/step");
    EXPECT_EQ(g.describe().passes[1].name, "right/step");
    EXPECT_EQ(frame(2, 1), std::pair(kRan, kSkipped)) << "what changes in one does not touch the other";
    right.reset();
    EXPECT_EQ(frame(2, 1), std::pair(kSkipped, kRan));
    EXPECT_TRUE(leftValid);
    EXPECT_FALSE(rightValid);
    frame(2, 1);
    EXPECT_TRUE(rightValid);
    g.removeScope(right);
    const GraphScope again = g.makeScope("again");  // takes its place, and nothing of what it had
    g.beginFrame(options);
    EXPECT_FALSE(declareSum(again, 1).valid);
    run();
    EXPECT_EQ(g.report().front().name, "again/step");
    EXPECT_EQ(g.report().front().outcome, kRan);
}

TEST_F(NullGraph, NestedScopesAreResetAndRemovedWithTheirs) {
    const GraphScope outer = g.makeScope("outer"), other = g.makeScope("other");
    bool inner = false, same = false;
    const auto frame = [&] {
        g.beginFrame(options);
        inner = declareSum(outer.nested("inner"), 1).valid;
        same = declareSum(other.nested("inner"), 1).valid;
        run();
        return std::pair(inner, same);
    };
    EXPECT_EQ(frame(), std::pair(false, false));
    EXPECT_EQ(g.describe().passes[0].name, "outer/inner/step");
    EXPECT_EQ(g.report()[0].name, "outer/inner/step") << "so that times of both are apart";
    EXPECT_EQ(frame(), std::pair(true, true)) << "the same scope by its name";
    outer.reset();
    EXPECT_EQ(frame(), std::pair(false, true));
    g.removeScope(outer);
    const GraphScope next = g.makeScope("next"), last = g.makeScope("last");
    g.beginFrame(options);
    EXPECT_FALSE(declareSum(next, 1).valid);
    EXPECT_FALSE(declareSum(last, 1).valid) << "in the places of both that were removed";
    run();
}

TEST_F(NullGraph, ResetForgetsAllThatAScopeMade) {
    const auto frame = [&] {
        g.beginFrame(options);
        const HistoryBuffer sum = declareSum(g, 1);
        const BufferHandle kept = g.buffer("kept", kBuffer);
        g.compute("make", "b.comp").read("sum", sum.current).write("out", kept);
        g.output(kept);
        run();
        return sum.valid;
    };
    frame();
    EXPECT_TRUE(frame());
    EXPECT_EQ(g.report()[0].outcome, PassOutcome::kSkipped);
    EXPECT_EQ(g.report()[1].outcome, PassOutcome::kSkipped);
    g.reset();
    EXPECT_FALSE(frame());
    EXPECT_EQ(g.report()[0].outcome, PassOutcome::kRan);
    EXPECT_EQ(g.report()[1].outcome, PassOutcome::kRan);
}

TEST_F(NullGraph, APassIsDeclaredWholeBeforeTheNext) {
    g.beginFrame(options);
    const BufferHandle out = g.buffer("out", kBuffer);
    PassBuilder first = g.compute("first", "a.comp");
    g.compute("second", "b.comp");
    EXPECT_DEATH(first.write("out", out), "first is declared on after second");
}

TEST_F(NullGraph, HistoriesBehindWhatIsHeldDoNotStep) {
    const auto frame = [&](uint64_t version, bool hold) {
        g.beginFrame(options);
        const HistoryBuffer first = g.historyBuffer("first", kBuffer),
                            then = g.historyBuffer("then", kBuffer);
        g.held(hold)
            .compute("first", "a.comp")
            .read("source", g.importBuffer("source", kBuffer, version))
            .readPrevious("before", first)
            .write("sum", first.current);
        g.compute("then", "b.comp")
            .read("sum", first.current)
            .readPrevious("before", then)
            .write("total", then.current);
        g.output(then.current);
        return run().at("then");
    };
    frame(1, false);
    EXPECT_EQ(frame(2, false), PassOutcome::kRan);
    EXPECT_EQ(frame(3, true), PassOutcome::kSkipped) << "what it reads is as it was";
    EXPECT_EQ(frame(4, true), PassOutcome::kSkipped);
    EXPECT_EQ(frame(4, false), PassOutcome::kRan);
    EXPECT_EQ(frame(4, false), PassOutcome::kSkipped);
}

TEST_F(NullGraph, OneResourceUnderTwoNamesIsMadeOnce) {
    const auto frame = [&](uint64_t version) {
        g.beginFrame(options);
        const BufferHandle both = g.buffer("both", kBuffer), out = g.buffer("out", kBuffer);
        g.compute("make", "a.comp").write("one", both).write("other", both).dispatchThreads(1);
        g.compute("use", "b.comp")
            .read("both", both)
            .read("source", g.importBuffer("source", kBuffer, version))
            .write("out", out);
        g.output(out);
        return run();
    };
    frame(1);
    EXPECT_EQ(frame(2).at("make"), PassOutcome::kSkipped);
}

TEST_F(NullGraph, APartThatIsKnownToBeTheSameIsReadAsTheSame) {
    const auto frame = [&](uint64_t version, uint64_t part) {
        g.beginFrame(options);
        const BufferHandle source = g.importBuffer("source", kBuffer, version),
                           out = g.buffer("out", kBuffer);
        g.compute("use", "b.comp").readPart("source", source, part).write("out", out);
        g.output(out);
        return run().at("use");
    };
    frame(1, 1);
    EXPECT_EQ(frame(2, 1), PassOutcome::kSkipped);
    EXPECT_EQ(frame(2, 2), PassOutcome::kRan);
}

TEST_F(NullGraph, ScratchIsMadeAgainOnlyForConsumersThatRun) {
    const auto declare = [&](uint64_t first, uint64_t second) {
        g.beginFrame(options);
        const ImageHandle s1 = g.image("s1", kScratchImage), s2 = g.image("s2", kScratchImage);
        const ImageHandle o1 = g.image("o1", kImage), o2 = g.image("o2", kImage);
        const BufferHandle i1 = g.importBuffer("i1", kBuffer, first),
                           i2 = g.importBuffer("i2", kBuffer, second);
        g.compute("fill.s1", "f.comp").write("s1", s1).dispatchThreads(1);
        g.compute("use.s1", "u.comp").read("s1", s1).read("i1", i1).write("o1", o1).dispatchThreads(1);
        g.compute("fill.s2", "f2.comp").write("s2", s2).dispatchThreads(1);
        g.compute("use.s2", "u2.comp").read("s2", s2).read("i2", i2).write("o2", o2).dispatchThreads(1);
        g.output(o1);
        g.output(o2);
        return run();
    };
    for (const auto& [name, outcome] : declare(1, 1))
        EXPECT_EQ(outcome, PassOutcome::kRan) << name;
    for (const auto& [name, outcome] : declare(1, 1))
        EXPECT_EQ(outcome, PassOutcome::kSkipped) << name;
    auto outcome = declare(2, 1);
    EXPECT_EQ(outcome.at("fill.s1"), PassOutcome::kRan) << "s2 took its memory";
    EXPECT_EQ(outcome.at("use.s1"), PassOutcome::kRan);
    EXPECT_EQ(outcome.at("fill.s2"), PassOutcome::kSkipped);
    EXPECT_EQ(outcome.at("use.s2"), PassOutcome::kSkipped);
    bool discards = false;
    for (const BarrierRecord& b : record("fill.s1").barriers)
        discards |= b.resource == "s1" && b.oldLayout == VK_IMAGE_LAYOUT_UNDEFINED &&
                    b.srcStages == VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    EXPECT_TRUE(discards) << "waits for whoever had the memory";
}

TEST_F(NullGraph, ResizedResourcesAreMadeAgain) {
    const auto declare = [&](uint32_t side) {
        g.beginFrame(options);
        ImageInfo info = kImage;
        info.size = {side, side};
        const ImageHandle a = g.image("a", info);
        g.compute("make", "m.comp").write("a", a).dispatchThreads(1);
        g.output(a);
        return run().at("make");
    };
    EXPECT_EQ(declare(64), PassOutcome::kRan);
    EXPECT_EQ(declare(64), PassOutcome::kSkipped);
    EXPECT_EQ(declare(32), PassOutcome::kRan);
    EXPECT_EQ(declare(32), PassOutcome::kSkipped);
}

TEST_F(NullGraph, NamesItselfForGraphviz) {
    g.beginFrame(options);
    declareChain(g, 1);
    run();
    EXPECT_NE(g.graphviz().find("make.a"), std::string::npos);
    EXPECT_NE(g.graphviz().find("digraph"), std::string::npos);
}

}  // namespace
}  // namespace ag
