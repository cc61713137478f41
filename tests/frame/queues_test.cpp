// How a frame is split between two queues of two families, without a device.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <set>
#include <string_view>

#include "engine/frame/frame_graph.h"

namespace ag {
namespace {

constexpr std::array<std::string_view, 12> kResources = {"r0", "r1", "r2", "r3", "r4",  "r5",
                                                         "r6", "r7", "r8", "r9", "r10", "r11"};
constexpr std::array<std::string_view, 40> kPasses = {
    "p0",  "p1",  "p2",  "p3",  "p4",  "p5",  "p6",  "p7",  "p8",  "p9",  "p10", "p11", "p12", "p13",
    "p14", "p15", "p16", "p17", "p18", "p19", "p20", "p21", "p22", "p23", "p24", "p25", "p26", "p27",
    "p28", "p29", "p30", "p31", "p32", "p33", "p34", "p35", "p36", "p37", "p38", "p39"};

struct TestPass {
    bool async = false, overwrites = false;
    uint32_t target = 0, source = 0;
    uint32_t push = 0;
};

bool isImage(uint32_t resource) {
    return resource % 2 == 0;
}

std::vector<TestPass> randomPasses(std::mt19937& random) {
    std::vector<TestPass> passes(kPasses.size());
    for (TestPass& p : passes) {
        p.async = random() % 2 == 0;
        p.target = uint32_t(random() % kResources.size());
        p.source = uint32_t((p.target + 1 + random() % (kResources.size() - 1)) % kResources.size());
        p.overwrites = random() % 2 == 0;
    }
    return passes;
}

void declare(FrameGraph& g, const std::vector<TestPass>& passes) {
    std::array<ImageHandle, kResources.size()> images;
    std::array<BufferHandle, kResources.size()> buffers;
    for (uint32_t r = 0; r < kResources.size(); ++r)
        if (isImage(r))
            images[r] = g.image(kResources[r], {.format = VK_FORMAT_R32_SFLOAT, .size = {8, 8}});
        else
            buffers[r] = g.buffer(kResources[r], {.sizeBytes = 64});
    for (size_t p = 0; p < passes.size(); ++p) {
        const TestPass& pass = passes[p];
        const GraphScope scope = pass.async ? g.async() : GraphScope(g);
        PassBuilder builder = scope.compute(kPasses[p], "any.comp");
        builder.push(pass.push);
        if (isImage(pass.source))
            builder.sample("source", images[pass.source]);
        else
            builder.read("source", buffers[pass.source]);
        if (isImage(pass.target))
            pass.overwrites ? builder.write("target", images[pass.target])
                            : builder.readWrite("target", images[pass.target]);
        else
            pass.overwrites ? builder.write("target", buffers[pass.target])
                            : builder.readWrite("target", buffers[pass.target]);
        builder.dispatchThreads(1);
    }
    for (uint32_t r = 0; r < kResources.size(); ++r)
        if (isImage(r))
            g.output(images[r]);
        else
            g.output(buffers[r]);
}

struct Split {
    std::vector<QueueBatch> batches;
    std::span<const PassRecord> records;
    std::span<const OwnerChange> changes;

    gpu::Queue queueOf(int32_t batch) const { return batches[size_t(batch)].queue; }
    // Whether all of batch `a` is over before batch `b` of the other queue begins.
    bool isBefore(int32_t a, int32_t b) const {
        for (int32_t i = 0; i <= b; ++i)
            if (queueOf(i) == queueOf(b) && batches[size_t(i)].after >= a) return true;
        return false;
    }
};

void checkOrder(const Split& s, const std::vector<TestPass>& passes) {
    const auto passOf = [&](const PassRecord& record) -> const TestPass& {
        return passes[size_t(std::ranges::find(kPasses, record.name) - kPasses.begin())];
    };
    for (size_t j = 0; j < s.records.size(); ++j)
        for (size_t i = 0; i < j; ++i) {
            const int32_t a = s.records[i].batch, b = s.records[j].batch;
            const TestPass &first = passOf(s.records[i]), &second = passOf(s.records[j]);
            if (s.queueOf(a) == s.queueOf(b)) {
                ASSERT_LE(a, b);
                continue;
            }
            const bool writes = first.target == second.target || first.target == second.source ||
                                first.source == second.target;
            const bool sharesImage = first.source == second.source && isImage(first.source);
            if (writes || sharesImage) {
                ASSERT_TRUE(s.isBefore(a, b)) << s.records[i].name << ", " << s.records[j].name;
            }
        }
}

// `used`: images that hold something, from frame to frame.
void checkOwners(const Split& s, const std::vector<TestPass>& passes, std::set<uint32_t>& used) {
    std::map<uint32_t, gpu::Queue> owner;
    const auto hasChange = [&](uint32_t image, int32_t to) {
        return std::ranges::any_of(s.changes, [&](const OwnerChange& c) {
            return c.resource == kResources[image] && c.to == to && s.queueOf(c.from) == owner[image] &&
                   s.isBefore(c.from, to);
        });
    };
    for (const PassRecord& record : s.records) {
        const TestPass& pass = passes[size_t(std::ranges::find(kPasses, record.name) - kPasses.begin())];
        for (const uint32_t r : {pass.source, pass.target}) {
            if (!isImage(r)) continue;
            const bool anew = (r == pass.target && pass.overwrites) || used.insert(r).second;
            if (owner[r] != s.queueOf(record.batch) && !anew) {
                ASSERT_TRUE(hasChange(r, record.batch)) << record.name << " " << kResources[r];
            }
            used.insert(r);
            owner[r] = s.queueOf(record.batch);
        }
    }
    for (auto [image, queue] : owner)
        if (queue == gpu::Queue::kAsync) {
            EXPECT_TRUE(hasChange(image, int32_t(s.batches.size()) - 1)) << "is left to the main queue";
        }
}

// A change of layout that names no stage may come before the semaphore that its queue waits for.
void checkLayouts(const Split& s, const std::set<uint32_t>& used) {
    for (const PassRecord& record : s.records)
        for (const BarrierRecord& barrier : record.barriers) {
            const uint32_t r = uint32_t(std::ranges::find(kResources, barrier.resource) - kResources.begin());
            if (barrier.oldLayout != barrier.newLayout && used.contains(r)) {
                ASSERT_NE(barrier.srcStages, 0u) << record.name << " " << barrier.resource;
            }
        }
}

TEST(Queues, WhatConflictsIsOrderedAndImagesHaveOneOwner) {
    std::mt19937 random(11);
    size_t changes = 0, batches = 0;
    for (int round = 0; round < 60; ++round) {
        FrameGraph g(nullptr, nullptr);
        std::vector<TestPass> passes = randomPasses(random);
        std::set<uint32_t> used;
        for (int frame = 0; frame < 4; ++frame) {
            g.beginFrame({});
            declare(g, passes);
            const auto none = [](gpu::Queue) { return VkCommandBuffer(VK_NULL_HANDLE); };
            const auto all = g.execute(VK_NULL_HANDLE, none);
            const Split s{{all.begin(), all.end()}, g.nullRecords(), g.ownerChanges()};
            ASSERT_EQ(s.batches.front().queue, gpu::Queue::kMain);
            ASSERT_EQ(s.batches.back().queue, gpu::Queue::kMain);
            for (int32_t b = 0; b < int32_t(s.batches.size()); ++b) {
                ASSERT_LT(s.batches[size_t(b)].after, b);
                if (s.queueOf(b) == gpu::Queue::kAsync) {
                    ASSERT_TRUE(s.isBefore(0, b)) << "of what was before the frame";
                    ASSERT_TRUE(s.isBefore(b, int32_t(s.batches.size()) - 1)) << "the frame's end waits";
                }
            }
            checkOrder(s, passes);
            checkLayouts(s, used);
            checkOwners(s, passes, used);
            changes += s.changes.size();
            batches += s.batches.size();
            passes[random() % passes.size()].push += 1;
        }
    }
    EXPECT_GT(changes, 1000u);
    EXPECT_GT(batches, 1000u);
}

// A chain on the second queue beside one on the main queue: three batches, and one wait each way.
TEST(Queues, IndependentChainsRunBesideEachOther) {
    FrameGraph g(nullptr, nullptr);
    g.beginFrame({});
    const BufferInfo info{.sizeBytes = 64};
    const BufferHandle start = g.buffer("start", info), a = g.buffer("a", info), b = g.buffer("b", info),
                       c = g.buffer("c", info), d = g.buffer("d", info), end = g.buffer("end", info);
    const GraphScope beside = g.async();
    g.compute("start", "s.comp").write("to", start).dispatchThreads(1);
    beside.compute("a", "s.comp").read("of", start).write("to", a).dispatchThreads(1);
    beside.compute("b", "s.comp").read("of", a).write("to", b).dispatchThreads(1);
    g.compute("c", "s.comp").read("of", start).write("to", c).dispatchThreads(1);
    g.compute("d", "s.comp").read("of", c).write("to", d).dispatchThreads(1);
    g.compute("end", "s.comp").read("one", b).read("two", d).write("to", end).dispatchThreads(1);
    g.output(end);
    const auto none = [](gpu::Queue) { return VkCommandBuffer(VK_NULL_HANDLE); };
    const auto batches = g.execute(VK_NULL_HANDLE, none);
    ASSERT_EQ(batches.size(), 4u);
    const std::array<int32_t, 6> expected = {0, 1, 1, 2, 2, 3};
    for (size_t i = 0; i < expected.size(); ++i)
        EXPECT_EQ(g.nullRecords()[i].batch, expected[i]) << g.nullRecords()[i].name;
    EXPECT_EQ(batches[1].after, 0);
    EXPECT_EQ(batches[2].after, -1) << "beside";
    EXPECT_EQ(batches[3].after, 1);
}

}  // namespace
}  // namespace ag
