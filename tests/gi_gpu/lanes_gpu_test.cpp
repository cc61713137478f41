// Kernels whose lanes exchange values, as subgroups and through shared memory, in groups of 4 to 64.
#include "engine/core/image_difference.h"
#include "tests/gi_gpu/bench.h"
#include "tools/scenegen/scenes.h"

namespace ag::gi {
using namespace render;
namespace {

std::unique_ptr<gpu::Device> deviceOf(uint32_t sharedLanes, bool gpuKernels = false) {
    auto device =
        gpu::Device::create({.validation = true, .sharedLanes = sharedLanes, .gpuKernels = gpuKernels});
    EXPECT_TRUE(device) << device.error().message;
    return std::move(*device);
}

// Lists whose order is defined, and the picture.
struct Outcome {
    std::vector<uint32_t> candidates, counts, slots;
    Image picture;
};

Outcome renderOn(gpu::Device& device, const char* preset) {
    Bench b(*scenegen::buildScene("corridor", 0), {48, 27}, device);
    EXPECT_TRUE(applyPreset(preset, b.settings));
    useSmallMaps(b.settings);
    b.frame();
    Outcome o;
    const Clusters& c = b.last.bounce.clusters;
    if (c.candidates) {
        o.candidates = b.read<uint32_t>(c.candidates);
        o.counts = b.read<uint32_t>(c.candidateCounts);
        o.slots = b.read<uint32_t>(c.slotOfTexel);
    }
    o.picture = renderLayer(b.renderer, b.scene, b.size, b.settings, Layer::kRadiance, 5);
    return o;
}

// Of each tile only so many candidates are written.
bool sameLists(const Outcome& a, const Outcome& b) {
    if (a.counts != b.counts || a.slots != b.slots) return false;
    const size_t most = a.counts.empty() ? 0 : a.candidates.size() / a.counts.size();
    for (size_t tile = 0; tile < a.counts.size(); ++tile)
        if (!std::equal(&a.candidates[tile * most], &a.candidates[tile * most] + a.counts[tile],
                        &b.candidates[tile * most]))
            return false;
    return true;
}

constexpr const char* kPresets[] = {"afterglow-bounces", "stochastic", "lightcluster"};

TEST(Lanes, SharedMemoryGivesTheBitsOfSubgroups) {
    const gpu::Lanes lanes = test::device().info().lanes;
    if (lanes.shared) GTEST_SKIP() << "the device has no subgroups of a known size";
    const auto shared = deviceOf(lanes.count);
    for (const char* preset : kPresets) {
        const Outcome native = renderOn(test::device(), preset), other = renderOn(*shared, preset);
        EXPECT_TRUE(sameLists(native, other)) << preset;
        EXPECT_EQ(native.picture.pixels, other.picture.pixels) << preset;
    }
}

// What runs on a GPU runs nowhere else: loops over lights with uniform addresses, sums by shuffles.
TEST(Lanes, KernelsForGpusGiveTheSamePicture) {
    const auto likeGpu = deviceOf(0, true);
    const Outcome expected = renderOn(test::device(), "afterglow-bounces"),
                  o = renderOn(*likeGpu, "afterglow-bounces");
    EXPECT_TRUE(sameLists(expected, o));
    EXPECT_LT(compareImages(expected.picture, o.picture)->relativeRmse, 0.001);
}

TEST(Lanes, GroupsOfAllSizesGiveTheSameListsAndPicture) {
    const auto four = deviceOf(4), thirtyTwo = deviceOf(32);
    for (const char* preset : kPresets) {
        const Outcome expected = renderOn(test::device(), preset);
        for (gpu::Device* device : {four.get(), thirtyTwo.get()}) {
            const Outcome o = renderOn(*device, preset);
            const uint32_t lanes = device->info().lanes.count;
            EXPECT_TRUE(sameLists(expected, o)) << preset << ' ' << lanes;
            EXPECT_LT(compareImages(expected.picture, o.picture)->relativeRmse, 0.01)
                << preset << ' ' << lanes;
        }
    }
}

}  // namespace
}  // namespace ag::gi
