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

// The best device that has everything required; otherwise a sentence saying what each one lacks. `without`:
// features to take as missing, limits to take as lower (LIMIT=N).
Result<DeviceChoice> chooseDevice(const Functions& vk, VkInstance instance, VkSurfaceKHR surface,
                                  const std::string& preferredName, std::span<const std::string> without);

// Device with one queue of the chosen family and the required features.
Result<VkDevice> openDevice(const Functions& vk, const DeviceChoice& choice, bool withSwapchain);

}  // namespace ag::gpu
