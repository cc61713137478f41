// What a Vulkan device is and can do, and what our code needs of one: Vulkan 1.3 (or 1.2 with the extensions
// that became it) with dynamicRendering, synchronization2, maintenance4, timelineSemaphore,
// scalarBlockLayout, hostQueryReset, multiDrawIndirect, drawIndirectFirstInstance; subgroup shuffle, ballot
// and arithmetic in compute.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/gpu/device_limits.h"
#include "engine/gpu/lanes.h"

namespace ag::gpu {

struct DeviceInfo {
    std::string name;    // "llvmpipe (LLVM 15.0.6, 256 bits)"
    std::string driver;  // driver name and version
    uint32_t apiVersion = 0;
    uint32_t subgroupSize = 0;
    Lanes lanes;
    float timestampPeriodNs = 0;  // 0: no timestamps
    bool calibrated = false;      // the device's clock can be read together with the host's
    bool counts = false;          // pipeline statistics
    float mostAnisotropy = 1;     // texels along a pixel's longer side that a sampler averages; 1: it cannot
    bool isCpu = false;           // lavapipe and its like: kernels take their lane-parallel shape
    VkPhysicalDeviceLimits limits{};
    bool storageTexels = false;        // shaders read storage buffers where they would texel buffers
    std::vector<std::string> enabled;  // feature and extension names switched on
    std::vector<std::string> missing;  // required and not there, as whatIsMissing says it
};

// Vulkan's feature structs, chained. Kept together so that asking and enabling use one list.
struct DeviceFeatures {
    VkPhysicalDeviceFeatures2 core{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2};
    VkPhysicalDeviceVulkan12Features v12{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES};
    VkPhysicalDeviceDynamicRenderingFeatures rendering{
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DYNAMIC_RENDERING_FEATURES};
    VkPhysicalDeviceSynchronization2Features synchronization{
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SYNCHRONIZATION_2_FEATURES};
    VkPhysicalDeviceMaintenance4Features maintenance{
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_4_FEATURES};
    // In the chain only where it is used: devices of 1.2 do not know it.
    VkPhysicalDeviceSubgroupSizeControlFeatures subgroupSizes{
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_SIZE_CONTROL_FEATURES};
    DeviceFeatures() {
        core.pNext = &v12;
        v12.pNext = &rendering;
        rendering.pNext = &synchronization;
        synchronization.pNext = &maintenance;
    }
    DeviceFeatures(const DeviceFeatures&) = delete;
    DeviceFeatures& operator=(const DeviceFeatures&) = delete;
};

struct RequiredFeature {
    const char* name;
    VkBool32& (*field)(DeviceFeatures&);
};
std::span<const RequiredFeature> requiredFeatures();
// Switches them on, and of what can be done without what `info` found to be of use.
void enable(DeviceFeatures& features, const DeviceInfo& info);

constexpr const char* kSubgroupOperations = "subgroup shuffle, ballot and arithmetic";
// A device that cannot replay buffer addresses is shown by RenderDoc as one of 1.2 with these.
std::span<const char* const> extensionsOf13();

// Everything but `calibrated`; what is required and not there is in `missing`.
DeviceInfo describeDevice(const Functions& vk, VkPhysicalDevice physical,
                          std::span<const LoweredLimit> lowered = {});
// "NAME lacks this, that", or empty.
std::string whatIsMissing(const DeviceInfo& info);
bool hasExtension(const Functions& vk, VkPhysicalDevice physical, const char* name);

}  // namespace ag::gpu
