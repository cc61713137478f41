// Picking a physical device and the features it is opened with.
#pragma once

#include <optional>
#include <span>

#include "engine/gpu/device.h"

namespace ag::gpu {

struct DeviceChoice {
    VkPhysicalDevice physical = VK_NULL_HANDLE;
    uint32_t queueFamily = 0;
    std::optional<uint32_t> asyncFamily;
    uint32_t asyncIndex = 0;  // of the queue in its family
    DeviceInfo info;
};

// The best device that has everything required; otherwise a sentence saying what each one lacks.
Result<DeviceChoice> chooseDevice(const Functions& vk, VkInstance instance, VkSurfaceKHR surface,
                                  const DeviceOptions& options);

// Device with the chosen queues and the required features.
Result<VkDevice> openDevice(const Functions& vk, const DeviceChoice& choice, bool withSwapchain);

}  // namespace ag::gpu
