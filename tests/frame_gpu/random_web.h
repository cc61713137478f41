// A graph on the tests' device, and random webs of passes for it.
#pragma once

#include <random>
#include <vector>

#include "engine/frame/frame_graph.h"
#include "engine/gpu/transfer.h"
#include "tests/support/device_environment.h"

namespace ag::test {

struct DeviceGraph {
    gpu::Device& device = test::device();
    FrameGraph graph{&device.context(), &device.pipelines()};
    FrameGraphOptions options{.timing = TimingMode::kOff};

    void execute() {
        device.runOnce([&](VkCommandBuffer commands) { graph.execute(commands); });
    }
    // The same in batches, each submitted by itself; returns how many there were.
    size_t executeInBatches() {
        const VkCommandPoolCreateInfo poolInfo{.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                               .queueFamilyIndex = device.queueFamily()};
        VkCommandPool pool = VK_NULL_HANDLE;
        AG_VK(device.vk().CreateCommandPool(device.handle(), &poolInfo, nullptr, &pool));
        const auto begin = [&](gpu::Queue) {
            const VkCommandBufferAllocateInfo info{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                                   .commandPool = pool,
                                                   .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
                                                   .commandBufferCount = 1};
            VkCommandBuffer commands = VK_NULL_HANDLE;
            AG_VK(device.vk().AllocateCommandBuffers(device.handle(), &info, &commands));
            const VkCommandBufferBeginInfo once{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
            AG_VK(device.vk().BeginCommandBuffer(commands, &once));
            return commands;
        };
        std::vector<uint64_t> values;
        for (const QueueBatch& batch : graph.execute(begin(gpu::Queue::kMain), begin)) {
            AG_VK(device.vk().EndCommandBuffer(batch.commands));
            values.push_back(device.submit({.commands = batch.commands,
                                            .queue = batch.queue,
                                            .after = batch.after < 0 ? 0 : values[size_t(batch.after)]}));
        }
        device.waitIdle();
        device.vk().DestroyCommandPool(device.handle(), pool, nullptr);
        return values.size();
    }
    std::vector<glm::vec4> read(ImageHandle handle) {
        const gpu::Image& image = graph.physical(handle);
        std::vector<glm::vec4> texels(size_t(image.desc().size.x) * image.desc().size.y);
        gpu::downloadImage(device, image, graph.layoutAfterFrame(handle),
                           std::as_writable_bytes(std::span(texels)));
        return texels;
    }
    std::vector<uint32_t> read(BufferHandle handle) {
        const gpu::Buffer& buffer = graph.physical(handle);
        std::vector<uint32_t> words(buffer.sizeBytes() / 4);
        gpu::downloadBuffer(device, buffer, std::as_writable_bytes(std::span(words)));
        return words;
    }
};

// A random web of images: some drawn, some mixed from two earlier ones, some in shared memory, some asked
// for.
struct Node {
    bool drawn = false, scratch = false, output = false, async = false;
    uint32_t a = 0, b = 0;
    float value = 0;
};

constexpr std::array<std::string_view, 14> kNames = {"n0", "n1", "n2", "n3",  "n4",  "n5",  "n6",
                                                     "n7", "n8", "n9", "n10", "n11", "n12", "n13"};

inline std::vector<Node> randomWeb(std::mt19937& random) {
    std::vector<Node> web(kNames.size());
    for (uint32_t i = 0; i < web.size(); ++i) {
        web[i].drawn = i < 2 || random() % 4 == 0;
        web[i].output = random() % 4 == 0 || i + 1 == web.size();
        web[i].scratch = !web[i].output && random() % 2 == 0;
        web[i].a = i ? uint32_t(random() % i) : 0;
        web[i].b = i ? uint32_t(random() % i) : 0;
        web[i].value = float(random() % 100) / 100;
        web[i].async = random() % 2 == 0;
    }
    return web;
}

inline std::vector<ImageHandle> declareWeb(DeviceGraph& g, const std::vector<Node>& web) {
    g.graph.beginFrame(g.options);
    std::vector<ImageHandle> images;
    for (uint32_t i = 0; i < web.size(); ++i) {
        const Node& n = web[i];
        images.push_back(
            g.graph.image(kNames[i], {.format = VK_FORMAT_R32G32B32A32_SFLOAT,
                                      .size = {32, 16},
                                      .lifetime = n.scratch ? Lifetime::kScratch : Lifetime::kKept}));
        if (n.drawn)
            g.graph.fullscreen(kNames[i], "test/draw_value.frag")
                .push(n.value)
                .colorClear(images[i], glm::vec4(0));
        else
            (n.async ? g.graph.async() : GraphScope(g.graph))
                .compute(kNames[i], "test/mix_images.comp")
                .sample("first", images[n.a])
                .sample("second", images[n.b])
                .write("result", images[i])
                .push(n.value)
                .dispatchThreads(32, 16);
        if (n.output) g.graph.output(images[i]);
    }
    return images;
}

inline std::vector<glm::vec4> readWeb(DeviceGraph& g, const std::vector<Node>& web,
                                      const std::vector<ImageHandle>& images) {
    std::vector<glm::vec4> all;
    for (uint32_t i = 0; i < web.size(); ++i) {
        if (!web[i].output) continue;
        const auto texels = g.read(images[i]);
        all.insert(all.end(), texels.begin(), texels.end());
    }
    return all;
}

inline std::vector<glm::vec4> runWeb(DeviceGraph& g, const std::vector<Node>& web) {
    const std::vector<ImageHandle> images = declareWeb(g, web);
    g.execute();
    return readWeb(g, web, images);
}

}  // namespace ag::test
