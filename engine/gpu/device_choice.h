// Picking a physical device and the features it is opened with.
#pragma once

#include <span>

#include "engine/gpu/device.h"

namespace ag::gpu {

struct DeviceChoice {
    VkPhysicalDevice physical = VK_NULL_HANDLE;
    uint32_t queueFamily = 0;
    DeviceInfo info;
};

// The best device that has everything required; otherwise a sentence saying what each one lacks.
Result<DeviceChoice> chooseDevice(const Functions& vk, VkInstance instance, VkSurfaceKHR surface,
                                  const DeviceOptions& options);

// Device with one queue of the chosen family and the required features.
Result<VkDevice> openDevice(const Functions& vk, const DeviceChoice& choice, bool withSwapchain);

}  // namespace ag::gpu
