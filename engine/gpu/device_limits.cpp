#include "engine/gpu/device_limits.h"

#include <algorithm>
#include <array>

#include "engine/core/failure.h"

namespace ag::gpu {
namespace {

#define AG_LIMIT(member, least)                                                          \
    DeviceLimit {                                                                        \
#member, least, [](VkPhysicalDeviceLimits & l) -> uint32_t& { return l.member; } \
    }

// Most are what Vulkan guarantees; a few kernels want more (workgroups of 256, nine storage buffers).
constexpr std::array kLimits = {AG_LIMIT(maxTexelBufferElements, 65536),
                                AG_LIMIT(maxStorageBufferRange, 1 << 27),
                                AG_LIMIT(maxUniformBufferRange, 16384),
                                AG_LIMIT(maxPushConstantsSize, 128),
                                AG_LIMIT(maxBoundDescriptorSets, 2),
                                AG_LIMIT(maxPerStageDescriptorSampledImages, 16),
                                AG_LIMIT(maxPerStageDescriptorSamplers, 16),
                                AG_LIMIT(maxPerStageDescriptorStorageBuffers, 10),
                                AG_LIMIT(maxPerStageDescriptorStorageImages, 4),
                                AG_LIMIT(maxPerStageDescriptorUniformBuffers, 12),
                                AG_LIMIT(maxPerStageResources, 32),
                                AG_LIMIT(maxComputeSharedMemorySize, 16384),
                                AG_LIMIT(maxComputeWorkGroupInvocations, 256),
                                AG_LIMIT(maxComputeWorkGroupSize[0], 256),
                                AG_LIMIT(maxComputeWorkGroupSize[1], 16),
                                AG_LIMIT(maxComputeWorkGroupCount[0], 65535),
                                AG_LIMIT(maxComputeWorkGroupCount[1], 65535),
                                AG_LIMIT(maxImageDimension2D, 4096),
                                AG_LIMIT(maxImageArrayLayers, 256),
                                AG_LIMIT(maxColorAttachments, 4)};
#undef AG_LIMIT

}  // namespace

std::span<const DeviceLimit> deviceLimits() {
    return kLimits;
}

const DeviceLimit* findDeviceLimit(std::string_view name) {
    const auto found = std::ranges::find(kLimits, name, &DeviceLimit::name);
    return found == kLimits.end() ? nullptr : &*found;
}

void lowerLimits(std::span<const LoweredLimit> lowered, VkPhysicalDeviceLimits& limits) {
    for (const LoweredLimit& l : lowered) {
        uint32_t& value = l.limit->of(limits);
        value = std::min(value, l.most);
    }
}

std::vector<std::string> lackingLimits(VkPhysicalDeviceLimits limits) {
    std::vector<std::string> lacking;
    for (const DeviceLimit& limit : kLimits)
        if (const uint32_t has = limit.of(limits); has < limit.least)
            lacking.push_back(std::string(limit.name) + " of " + std::to_string(limit.least) + " (it has " +
                              std::to_string(has) + ")");
    return lacking;
}

void failBeyondLimit(const std::string& what, std::string_view limit, uint64_t wanted, uint64_t has) {
    fail(FailureKind::kUnsupported, what + " wants " + std::to_string(wanted) + ", more than this device's " +
                                        std::string(limit) + " of " + std::to_string(has) +
                                        ": a smaller scene, size or quality needs less");
}

bool hasLargeTexelBuffers(const VkPhysicalDeviceLimits& limits) {
    constexpr uint32_t kWordsOfAnyStorageBuffer = (1u << 27) / 4;
    return limits.maxTexelBufferElements >= kWordsOfAnyStorageBuffer;
}

}  // namespace ag::gpu
