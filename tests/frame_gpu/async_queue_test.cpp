// Frames on two queues, on a device that may have one alone: what would be the second queue's work goes to it
// by itself.
#include <gtest/gtest.h>

#include "engine/frame/frame_timer.h"
#include "tests/frame_gpu/random_web.h"

namespace ag {
namespace {

using namespace test;

TEST(AsyncQueue, ChangesNoBit) {
    auto device = gpu::Device::create({.validation = true, .asyncQueue = gpu::AsyncQueue::kAlone});
    ASSERT_TRUE(device) << device.error().message;
    ASSERT_TRUE((*device)->context().asyncFamily());
    std::mt19937 random(23);
    size_t batches = 0, frames = 0;
    for (int round = 0; round < 3; ++round) {
        DeviceGraph split{.device = **device}, plain{.device = **device};
        std::vector<Node> web = randomWeb(random);
        for (int frame = 0; frame < 10; ++frame, ++frames) {
            if (frame % 3 != 0) web[random() % web.size()].value += 0.125f;
            if (frame == 4) web[5].async = !web[5].async;
            const std::vector<ImageHandle> images = declareWeb(split, web);
            batches += split.executeInBatches();
            ASSERT_EQ(readWeb(split, web, images), runWeb(plain, web))
                << "round " << round << " frame " << frame;
        }
    }
    EXPECT_GT(batches, 2 * frames) << "frames were split";
}

TEST(AsyncQueue, PassesOfBothQueuesHaveTimes) {
    auto device = gpu::Device::create({.validation = true, .asyncQueue = gpu::AsyncQueue::kAlone});
    ASSERT_TRUE(device) << device.error().message;
    DeviceGraph g{.device = **device, .options = {.skip = false, .timing = TimingMode::kTimestamps}};
    for (uint32_t frame = 0; frame <= kTimerFrames; ++frame) {
        g.graph.beginFrame(g.options);
        const ImageInfo info{.format = VK_FORMAT_R32G32B32A32_SFLOAT, .size = {256, 256}};
        const ImageHandle drawn = g.graph.image("drawn", info), mixed = g.graph.image("mixed", info);
        g.graph.fullscreen("draw", "test/draw_value.frag").push(0.25f).colorClear(drawn, glm::vec4(0));
        g.graph.async()
            .compute("mix", "test/mix_images.comp")
            .sample("first", drawn)
            .sample("second", drawn)
            .write("result", mixed)
            .push(0.5f)
            .dispatchThreads(256, 256);
        g.graph.output(mixed);
        EXPECT_EQ(g.executeInBatches(), 3u) << "draw, mix, the end";
    }
    for (const PassReport& pass : g.graph.report())
        EXPECT_GT(pass.gpuMs, 0) << pass.name;
}

}  // namespace
}  // namespace ag
