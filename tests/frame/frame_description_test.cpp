// What the graph says of a frame: who reads what, how much, and why something did not run.
#include "engine/frame/frame_description.h"
#include "tests/frame/kilobyte.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace ag {
namespace {

const PassDescription& pass(const FrameDescription& frame, std::string_view name) {
    return *std::ranges::find(frame.passes, name, &PassDescription::name);
}

std::vector<std::string> names(const FrameDescription& frame, const std::vector<uint32_t>& resources) {
    std::vector<std::string> out;
    for (uint32_t r : resources)
        out.push_back(frame.resources[r].name);
    return out;
}

// source -> a -> scratch image -> b (output); c is read by nobody.
FrameDescription run(FrameGraph& g, uint64_t version) {
    g.beginFrame({});
    const BufferHandle source = g.importBuffer("source", kBuffer, version);
    const BufferHandle a = g.buffer("a", kBuffer), b = g.buffer("b", kBuffer), c = g.buffer("c", kBuffer);
    const ImageHandle between =
        g.image("between",
                {.format = VK_FORMAT_R16G16B16A16_SFLOAT, .size = {64, 32}, .lifetime = Lifetime::kScratch});
    const ImageHandle other = g.image(
        "other", {.format = VK_FORMAT_R16G16B16A16_SFLOAT, .size = {64, 32}, .lifetime = Lifetime::kScratch});
    g.compute("make.a", "a.comp").read("source", source).write("a", a).dispatchThreads(100, 2);
    g.fullscreen("make.between", "between.frag").read("a", a).colorClear(between, glm::vec4(0));
    g.compute("make.b", "b.comp").sample("between", between).readWrite("b", b).dispatchThreads(1);
    g.fullscreen("make.other", "other.frag").read("b", b).colorClear(other, glm::vec4(0));
    g.compute("more.b", "b.comp").sample("other", other).readWrite("b", b).dispatchThreads(1);
    g.fill("make.c", c, 1);
    g.output(b);
    g.execute(VK_NULL_HANDLE);
    return g.describe();
}

TEST(FrameDescription, SaysWhoTouchesWhatAndHowMuch) {
    FrameGraph g(nullptr, nullptr);
    const FrameDescription frame = run(g, 1);
    EXPECT_EQ(frame.frame, 1u);
    ASSERT_EQ(frame.passes.size(), 6u);
    const PassDescription& a = pass(frame, "make.a");
    EXPECT_EQ(names(frame, a.reads), std::vector<std::string>{"source"});
    EXPECT_EQ(names(frame, a.writes), std::vector<std::string>{"a"});
    EXPECT_EQ(a.resourceBytes, 2048u);
    EXPECT_EQ(a.work, 200u);
    const PassDescription& between = pass(frame, "make.between");
    EXPECT_EQ(between.work, 64u * 32u);
    EXPECT_EQ(between.unit, WorkUnit::kPixels);
    EXPECT_EQ(between.resourceBytes, 1024u + 64u * 32u * 8u);
    const PassDescription& b = pass(frame, "make.b");
    EXPECT_EQ(names(frame, b.reads), (std::vector<std::string>{"between", "b"}));
    EXPECT_EQ(b.resourceBytes, 1024u + 64u * 32u * 8u) << "what is read and written counts once";
    EXPECT_EQ(frame.resources[0].role, ResourceRole::kImport);
}

TEST(FrameDescription, SaysWhyAPassDidNotRun) {
    FrameGraph g(nullptr, nullptr);
    FrameDescription frame = run(g, 1);
    EXPECT_EQ(pass(frame, "make.a").reason, "");
    EXPECT_EQ(pass(frame, "make.c").reason, "nobody reads it");
    frame = run(g, 1);
    EXPECT_EQ(pass(frame, "make.a").reason, "nothing it reads changed");
    EXPECT_EQ(pass(frame, "more.b").reason, "nothing it reads changed");
    for (const PassDescription& p : frame.passes)
        EXPECT_EQ(p.reason.empty(), p.outcome == PassOutcome::kRan) << p.name;
}

}  // namespace
}  // namespace ag
