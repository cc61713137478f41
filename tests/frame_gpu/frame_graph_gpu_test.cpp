// The graph on a device, its barriers alone between the passes (timing is off) and synchronization validation
// watching.
#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "engine/frame/frame_graph.h"
#include "engine/frame/frame_timer.h"
#include "engine/gpu/transfer.h"
#include "tests/frame_gpu/random_web.h"

namespace ag {
namespace {

using namespace test;

TEST(DeviceGraph, HistoriesCountTheirSteps) {
    DeviceGraph g;
    const auto frame = [&](uint64_t step, bool skip) {
        g.options.skip = skip;
        g.graph.beginFrame(g.options);
        const HistoryBuffer h = g.graph.historyBuffer("counter", {.sizeBytes = 256});
        g.graph.compute("count", "test/add_step.comp")
            .readPrevious("previous", h)
            .write("current", h.current)
            .step(step)
            .dispatchThreads(64);
        g.graph.output(h.current);
        g.execute();
        return g.read(h.current)[7];
    };
    EXPECT_EQ(frame(1, true), 1u);
    EXPECT_EQ(frame(1, true), 1u);
    EXPECT_EQ(frame(2, true), 2u);
    EXPECT_EQ(frame(2, false), 2u) << "running it again is no step";
    EXPECT_EQ(frame(3, false), 3u);
    EXPECT_EQ(frame(4, true), 4u);
    g.graph.resetHistory("counter");
    EXPECT_EQ(frame(5, true), 1u);
}

TEST(DeviceGraph, WhatIsReadBackIsOfTwoFramesBefore) {
    DeviceGraph g;
    const auto frame = [&](uint32_t word) {
        g.graph.beginFrame(g.options);
        const BufferHandle b = g.graph.buffer("words", {.sizeBytes = 64});
        g.graph.fill("fill", b, word);
        const std::span<const std::byte> read = g.graph.readBack({"read0", "read1"}, b);
        uint32_t got = 0;
        if (!read.empty()) std::memcpy(&got, read.data() + 60, 4);
        g.execute();
        return got;
    };
    const auto outcome = [&] { return g.graph.report().back().outcome; };
    EXPECT_EQ(frame(7), 0u) << "nothing yet";
    EXPECT_EQ(frame(8), 0u);
    EXPECT_EQ(frame(9), 7u);
    EXPECT_EQ(frame(9), 8u);
    EXPECT_EQ(outcome(), PassOutcome::kRan);
    EXPECT_EQ(frame(9), 9u);
    EXPECT_EQ(frame(9), 9u);
    EXPECT_EQ(outcome(), PassOutcome::kSkipped) << "both copies hold it";
    EXPECT_EQ(frame(5), 9u);
    EXPECT_EQ(frame(5), 9u);
    EXPECT_EQ(frame(5), 5u);
}

TEST(DeviceGraph, PassesHaveTheirPlaceOnTheHostsClock) {
    DeviceGraph g;
    g.options = {.skip = false, .timing = TimingMode::kBracketed};
    const auto before = g.device.readClocks();
    if (!before) {
        ASSERT_EQ(g.device.info().name.find("llvmpipe"), std::string::npos)
            << "lavapipe has calibrated timestamps";
        GTEST_SKIP() << g.device.info().name << " has none";
    }
    const auto draw = [&](uint32_t repeats) {
        g.options.repeatPass = "draw.first";
        g.options.repeats = repeats;
        g.graph.beginFrame(g.options);
        const ImageInfo info{.format = VK_FORMAT_R32G32B32A32_SFLOAT, .size = {512, 512}};
        for (const std::string_view name : {"first", "second"}) {
            const ImageHandle image = g.graph.image(name, info);
            g.graph.fullscreen(name == "first" ? "draw.first" : "draw.second", "test/draw_value.frag")
                .push(0.5f)
                .colorClear(image, glm::vec4(0));
            g.graph.output(image);
        }
        g.execute();
    };
    for (uint32_t frame = 0; frame < 2 * kTimerFrames; ++frame)
        draw(40);
    const auto after = g.device.readClocks();
    const FrameSpans spans = g.graph.spans();
    EXPECT_EQ(spans.frame + kTimerFrames, g.graph.frame());
    ASSERT_EQ(spans.passes.size(), 2u);
    const PassSpan first = spans.passes[0], second = spans.passes[1];
    EXPECT_EQ(first.name, "draw.first");
    EXPECT_LT(first.beginTicks, first.endTicks);
    EXPECT_LE(first.endTicks, second.beginTicks);
    EXPECT_LE(before->deviceTicks, first.beginTicks);
    EXPECT_LE(second.endTicks, after->deviceTicks);
    EXPECT_GT(after->hostNs, before->hostNs);
    EXPECT_GT(first.endTicks - first.beginTicks, 5 * (second.endTicks - second.beginTicks))
        << "forty times the work";
}

TEST(DeviceGraph, PassTimesArrive) {
    DeviceGraph g;
    g.options = {.skip = false};
    for (int frame = 0; frame < 5; ++frame) {
        g.graph.beginFrame(g.options);
        const ImageHandle image =
            g.graph.image("image", {.format = VK_FORMAT_R32G32B32A32_SFLOAT, .size = {64, 64}});
        g.graph.fullscreen("draw", "test/draw_value.frag").push(0.5f).colorClear(image, glm::vec4(0));
        g.graph.output(image);
        g.execute();
    }
    EXPECT_GT(g.graph.report()[0].gpuMs, 0);
    g.options.timing = TimingMode::kProcessCpu;
    g.graph.beginFrame(g.options);
    const ImageHandle image =
        g.graph.image("image", {.format = VK_FORMAT_R32G32B32A32_SFLOAT, .size = {64, 64}});
    g.graph.fullscreen("draw", "test/draw_value.frag").push(0.25f).colorClear(image, glm::vec4(0));
    g.graph.output(image);
    g.graph.executeAlone([&](const auto& record) { return g.device.timeOnCpu(record); });
    EXPECT_GT(g.graph.report()[0].cpuMs, 0);
    EXPECT_EQ(g.read(image)[0].x, 0.25f);
}

// A host's image: written by a pass, left in the layout the host wants, not written again while the host
// leaves it alone.
TEST(DeviceGraph, WritesAHostsImage) {
    DeviceGraph g;
    const gpu::ImageDesc desc{.name = "host", .format = VK_FORMAT_R32G32B32A32_SFLOAT, .size = {32, 16}};
    const gpu::Image host(g.device, desc);
    const gpu::Image borrowed(g.device, desc, host.handle(), host.view());
    const auto frame = [&](const Borrowed& how, float value) {
        g.graph.beginFrame(g.options);
        const ImageHandle image = g.graph.borrowImage("host", borrowed, how);
        g.graph.fullscreen("draw", "test/draw_value.frag").push(value).colorClear(image, glm::vec4(0));
        g.execute();
        return g.graph.report()[0].outcome;
    };
    const auto content = [&] {
        std::vector<glm::vec4> texels(32 * 16);
        gpu::downloadImage(g.device, host, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
                           std::as_writable_bytes(std::span(texels)));
        return texels[100].x;
    };
    constexpr VkImageLayout kRead = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    EXPECT_EQ(frame({VK_IMAGE_LAYOUT_UNDEFINED, kRead}, 0.25f), PassOutcome::kRan);
    EXPECT_EQ(content(), 0.25f);
    EXPECT_EQ(frame({kRead, kRead, true}, 0.25f), PassOutcome::kSkipped);
    EXPECT_EQ(frame({kRead, kRead, false}, 0.25f), PassOutcome::kRan) << "the host may have changed it";
    EXPECT_EQ(frame({kRead, kRead, true}, 0.5f), PassOutcome::kRan);
    EXPECT_EQ(content(), 0.5f);
}

// What a callback draws stands in the frame as any pass does: between barriers, and skipped by its key.
TEST(DeviceGraph, PassesMayRecordByThemselves) {
    DeviceGraph g;
    uint32_t calls = 0;
    const auto frame = [&](uint64_t key, float value) {
        g.graph.beginFrame(g.options);
        const ImageHandle image =
            g.graph.image("image", {.format = VK_FORMAT_R32G32B32A32_SFLOAT, .size = {64, 64}});
        g.graph.callback("host.draw")
            .colorClear(image, glm::vec4(0.125f))
            .key(key)
            .record([&](const auto& r) {
                ++calls;
                EXPECT_EQ(r.size, glm::uvec2(64));
                const VkClearAttachment clear{.aspectMask = VK_IMAGE_ASPECT_COLOR_BIT,
                                              .clearValue = {.color = {{value, 0, 0, 0}}}};
                const VkClearRect half{{{0, 0}, {32, 64}}, 0, 1};
                g.device.vk().CmdClearAttachments(r.commands, 1, &clear, 1, &half);
            });
        g.graph.output(image);
        g.execute();
        return g.read(image);
    };
    const auto first = frame(1, 0.5f);
    EXPECT_EQ(first[0].x, 0.5f);
    EXPECT_EQ(first[63].x, 0.125f);
    EXPECT_EQ(frame(1, 0.75f)[0].x, 0.5f) << "its key says that it draws the same";
    EXPECT_EQ(calls, 1u);
    EXPECT_EQ(frame(2, 0.75f)[0].x, 0.75f);
    EXPECT_EQ(calls, 2u);
}

TEST(DeviceGraph, SkippingAndSharedMemoryChangeNoBit) {
    std::mt19937 random(17);
    int skipped = 0;
    for (int round = 0; round < 8; ++round) {
        DeviceGraph fast, plain;
        plain.options.skip = plain.options.alias = false;
        std::vector<Node> web = randomWeb(random);
        for (int frame = 0; frame < 12; ++frame) {
            if (frame % 3 != 0) web[random() % web.size()].value += 0.125f;
            if (frame == 6) web[3].output = !web[3].output;
            ASSERT_EQ(runWeb(fast, web), runWeb(plain, web)) << "round " << round << " frame " << frame;
            for (const PassReport& pass : fast.graph.report())
                skipped += pass.outcome == PassOutcome::kSkipped;
        }
    }
    EXPECT_GT(skipped, 100);
}

}  // namespace
}  // namespace ag
