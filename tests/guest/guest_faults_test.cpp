// Whatever fails under the library comes back as a code; what can be tried again works then; nothing is lost.
#include <gtest/gtest.h>

#include <functional>

#include "tests/guest/guest_host.h"
#include "tests/guest/vulkan_faults.h"
#include "tests/support/allocation_counter.h"

namespace ag::test {
namespace {

// A host's life, step by step: a step that fails is tried once more.
class FaultyHost {
  public:
    using Arm = std::function<void()>;

    // `expected`: what a failing step may return. `disarm`: before it is tried again.
    FaultyHost(AgiResult expected, Arm disarm) : expected_(expected), disarm_(std::move(disarm)) {
        const gpu::Functions& vk = device().vk();
        const VkCommandPoolCreateInfo info{.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                           .queueFamilyIndex = device().queueFamily()};
        vk.CreateCommandPool(device().handle(), &info, nullptr, &pool_);
        const VkCommandBufferAllocateInfo allocation{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO, nullptr,
                                                     pool_, VK_COMMAND_BUFFER_LEVEL_PRIMARY, 1};
        vk.AllocateCommandBuffers(device().handle(), &allocation, &commands_);
    }
    ~FaultyHost() { device().vk().DestroyCommandPool(device().handle(), pool_, nullptr); }

    // Returns how many steps failed.
    int live(const Arm& arm) {
        const AgiContextInfo info = contextInfo({.getInstanceProcAddr = faultyGetInstanceProcAddr});
        AgiViewInfo viewInfo{AGI_INIT(AgiViewInfo)};
        viewInfo.width = camera_.frame().width;
        viewInfo.height = camera_.frame().height;
        viewInfo.preset = "medium";  // rays are cast, from the second frame on
        arm();
        if (step([&] { return agiCreateContext(&info, &context_); }) &&
            step([&] { return agiCreateScene(context_, &scene_); }) &&
            step([&] { return room_.fill(scene_); }) && step([&] { return addLight(); }) &&
            step([&] { return agiCreateView(context_, &viewInfo, &view_); }) &&
            step([&] { return agiPrepare(view_, scene_); }))
            for (int i = 0; i < 3 && step([&] { return drawFrame(); }); ++i) {
            }
        disarm_();
        if (!lost_) {
            EXPECT_GT(meanOf(camera_.irradiance()), 0.001);
        }
        agiDestroyView(view_);
        agiDestroyScene(scene_);
        agiDestroyContext(context_);
        return failures_;
    }

  private:
    bool step(const std::function<AgiResult()>& what) {
        AgiResult result = what();
        if (result == AGI_OK) return true;
        ++failures_;
        EXPECT_EQ(result, expected_) << agiLastError();
        EXPECT_STRNE(agiLastError(), "");
        lost_ = result == AGI_ERROR_DEVICE_LOST;
        if (lost_) return false;
        disarm_();
        result = what();
        EXPECT_EQ(result, AGI_OK) << agiLastError();
        return result == AGI_OK;
    }

    // A sky, and a box that shines.
    AgiResult addLight() {
        const float white[3] = {1, 1, 1};
        AgiSky sky{AGI_INIT(AgiSky)};
        sky.width = sky.height = 1;
        sky.radiance = white;
        AgiMaterial shining{AGI_INIT(AgiMaterial)};
        for (float& channel : shining.emissive)
            channel = 1;
        const AgiResult result = agiSetSky(scene_, &sky);
        return result == AGI_OK ? agiUpdateMaterials(scene_, 1, 1, &shining) : result;
    }

    AgiResult drawFrame() {
        const gpu::Functions& vk = device().vk();
        {
            const UncountedAllocations hosts;
            vk.ResetCommandPool(device().handle(), pool_, 0);
            const VkCommandBufferBeginInfo begin{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
            vk.BeginCommandBuffer(commands_, &begin);
        }
        AgiFrame f = camera_.frame();
        f.frame = done_ + 1;
        f.framesDone = done_;
        const AgiResult result = agiRecord(view_, scene_, commands_, &f);
        const UncountedAllocations hosts;
        vk.EndCommandBuffer(commands_);
        if (result != AGI_OK) return result;
        device().waitFor(device().submit(commands_));
        ++done_;
        return AGI_OK;
    }

    AgiResult expected_;
    Arm disarm_;
    HostRoom room_;
    HostCamera camera_{room_.room(), {.size = {32, 18}}};
    VkCommandPool pool_ = VK_NULL_HANDLE;
    VkCommandBuffer commands_ = VK_NULL_HANDLE;
    AgiContext context_ = nullptr;
    AgiScene scene_ = nullptr;
    AgiView view_ = nullptr;
    uint64_t done_ = 0;
    int failures_ = 0;
    bool lost_ = false;
};

int vulkanCallsOfALife() {
    static const int calls = [] {
        FaultyHost(AGI_OK, [] {}).live(vulkanWorks);
        return countedVulkanCalls();
    }();
    return calls;
}

// Some of the `count` places, the first ones among them.
std::vector<int> placesAmong(int count, int wanted) {
    std::vector<int> places;
    for (int i = 0; i < wanted; ++i)
        places.push_back(int(int64_t(count - 1) * i / (wanted - 1)));
    return places;
}

// A failure may be got round, as that of a full descriptor pool is: not most of them.
void failEverywhere(VkResult failure, AgiResult expected, int places) {
    int failures = 0;
    for (const int place : placesAmong(vulkanCallsOfALife(), places)) {
        SCOPED_TRACE(place);
        FaultyHost host(expected, vulkanWorks);
        failures += host.live([&] { failVulkanAfter(place, failure); });
    }
    EXPECT_LE(failures, places);
    EXPECT_GT(failures, places / 2);
}

TEST(GuestFaults, OutOfDeviceMemoryIsACodeAndTriedAgain) {
    failEverywhere(VK_ERROR_OUT_OF_DEVICE_MEMORY, AGI_ERROR_DEVICE_MEMORY, 10);
}

TEST(GuestFaults, OutOfHostMemoryInVulkanIsACodeAndTriedAgain) {
    failEverywhere(VK_ERROR_OUT_OF_HOST_MEMORY, AGI_ERROR_HOST_MEMORY, 8);
}

TEST(GuestFaults, ALostDeviceIsACodeAndAllCanBeDestroyed) {
    failEverywhere(VK_ERROR_DEVICE_LOST, AGI_ERROR_DEVICE_LOST, 9);
}

TEST(GuestFaults, OutOfHostMemoryOfOurOwnIsACodeAndTriedAgain) {
    vulkanWorks();
    const auto never = [] { failAllocationAfter(~size_t(0)); };
    startCounting();
    FaultyHost(AGI_OK, [] {}).live([] {});
    const auto allocations = int(stopCounting());
    for (const int place : placesAmong(allocations, 11)) {
        SCOPED_TRACE(place);
        FaultyHost host(AGI_ERROR_HOST_MEMORY, never);
        EXPECT_LE(host.live([&] { failAllocationAfter(size_t(place)); }), 1);
    }
}

}  // namespace
}  // namespace ag::test
