#include "engine/gpu/device_info.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace ag::gpu {
namespace {

#define AG_FEATURE(part, member)                                               \
    RequiredFeature {                                                          \
#member, [](DeviceFeatures & f) -> VkBool32& { return f.part.member; } \
    }

const std::array kRequired = {AG_FEATURE(core.features, multiDrawIndirect),
                              AG_FEATURE(core.features, drawIndirectFirstInstance),
                              AG_FEATURE(v12, timelineSemaphore),
                              AG_FEATURE(v12, scalarBlockLayout),
                              AG_FEATURE(v12, hostQueryReset),
                              AG_FEATURE(rendering, dynamicRendering),
                              AG_FEATURE(synchronization, synchronization2),
                              AG_FEATURE(maintenance, maintenance4)};
#undef AG_FEATURE

constexpr std::array kExtensionsOf13 = {VK_KHR_DYNAMIC_RENDERING_EXTENSION_NAME,
                                        VK_KHR_SYNCHRONIZATION_2_EXTENSION_NAME,
                                        VK_KHR_MAINTENANCE_4_EXTENSION_NAME};

SubgroupSizes subgroupSizes(const Functions& vk, VkPhysicalDevice physical, const DeviceInfo& info) {
    if (info.apiVersion < VK_API_VERSION_1_3) return {.usual = info.subgroupSize};
    VkPhysicalDeviceSubgroupSizeControlProperties sizes{
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_SIZE_CONTROL_PROPERTIES};
    VkPhysicalDeviceProperties2 properties{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2,
                                           .pNext = &sizes};
    vk.GetPhysicalDeviceProperties2(physical, &properties);
    VkPhysicalDeviceSubgroupSizeControlFeatures has{
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_SIZE_CONTROL_FEATURES};
    VkPhysicalDeviceFeatures2 features{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, .pNext = &has};
    vk.GetPhysicalDeviceFeatures2(physical, &features);
    return {.usual = info.subgroupSize,
            .least = sizes.minSubgroupSize,
            .most = sizes.maxSubgroupSize,
            .canBeRequested = has.subgroupSizeControl && has.computeFullSubgroups &&
                              (sizes.requiredSubgroupSizeStages & VK_SHADER_STAGE_COMPUTE_BIT)};
}

void readProperties(const Functions& vk, VkPhysicalDevice physical, DeviceInfo& info) {
    VkPhysicalDeviceSubgroupProperties subgroup{.sType =
                                                    VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_PROPERTIES};
    VkPhysicalDeviceDriverProperties driver{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES,
                                            .pNext = &subgroup};
    VkPhysicalDeviceProperties2 properties{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2,
                                           .pNext = &driver};
    vk.GetPhysicalDeviceProperties2(physical, &properties);
    info.name = properties.properties.deviceName;
    info.driver = std::string(driver.driverName) + " " + driver.driverInfo;
    info.apiVersion = properties.properties.apiVersion;
    info.subgroupSize = subgroup.subgroupSize;
    info.limits = properties.properties.limits;
    info.isCpu = properties.properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU;
    info.lanes = chooseLanes(subgroupSizes(vk, physical, info), info.isCpu);
    info.timestampPeriodNs = info.limits.timestampComputeAndGraphics ? info.limits.timestampPeriod : 0;
    constexpr VkSubgroupFeatureFlags kSubgroup =
        VK_SUBGROUP_FEATURE_SHUFFLE_BIT | VK_SUBGROUP_FEATURE_BALLOT_BIT | VK_SUBGROUP_FEATURE_ARITHMETIC_BIT;
    const bool has = (subgroup.supportedOperations & kSubgroup) == kSubgroup &&
                     (subgroup.supportedStages & VK_SHADER_STAGE_COMPUTE_BIT);
    (has ? info.enabled : info.missing).push_back(kSubgroupOperations);
    // Its generator of fragment shaders knows rows of 4 and 8 pixels (lp_build_depth_stencil_load_swizzled
    // and generate_fs_twiddle of Mesa 22.3 assert it): wider ones end in a crash of its compiler.
    constexpr uint32_t kMostLavapipeLanes = 8;
    if (driver.driverID == VK_DRIVER_ID_MESA_LLVMPIPE && subgroup.subgroupSize > kMostLavapipeLanes)
        info.missing.push_back(
            "fragment shaders of such width, a fault of its own (LP_NATIVE_VECTOR_WIDTH may be 128 or 256)");
}

bool hasPartsOf13(const Functions& vk, VkPhysicalDevice physical) {
    return std::ranges::all_of(kExtensionsOf13,
                               [&](const char* part) { return hasExtension(vk, physical, part); });
}

// Fills enabled and missing with the required features.
void listFeatures(const Functions& vk, VkPhysicalDevice physical, DeviceInfo& info) {
    if (info.apiVersion < VK_API_VERSION_1_2 ||
        (info.apiVersion < VK_API_VERSION_1_3 && !hasPartsOf13(vk, physical))) {
        info.missing.push_back("Vulkan 1.3");
        return;
    }
    DeviceFeatures has;
    vk.GetPhysicalDeviceFeatures2(physical, &has.core);
    for (const RequiredFeature& feature : kRequired)
        (feature.field(has) ? info.enabled : info.missing).push_back(feature.name);
    info.counts = has.core.features.pipelineStatisticsQuery;  // done without where not
    if (info.counts) info.enabled.push_back("pipelineStatisticsQuery");
    info.mostAnisotropy = has.core.features.samplerAnisotropy ? info.limits.maxSamplerAnisotropy : 1;
}

}  // namespace

std::span<const RequiredFeature> requiredFeatures() {
    return kRequired;
}

void enable(DeviceFeatures& features, const DeviceInfo& info) {
    for (const RequiredFeature& feature : kRequired)
        feature.field(features) = VK_TRUE;
    features.core.features.pipelineStatisticsQuery = info.counts;
    features.core.features.samplerAnisotropy = info.mostAnisotropy > 1;
    if (!info.lanes.requested) return;
    features.subgroupSizes.subgroupSizeControl = features.subgroupSizes.computeFullSubgroups = VK_TRUE;
    features.maintenance.pNext = &features.subgroupSizes;
}

std::span<const char* const> extensionsOf13() {
    return kExtensionsOf13;
}

DeviceInfo describeDevice(const Functions& vk, VkPhysicalDevice physical,
                          std::span<const LoweredLimit> lowered) {
    DeviceInfo info;
    readProperties(vk, physical, info);
    listFeatures(vk, physical, info);
    lowerLimits(lowered, info.limits);
    for (std::string& limit : lackingLimits(info.limits))
        info.missing.push_back(std::move(limit));
    info.storageTexels = !hasLargeTexelBuffers(info.limits);
    return info;
}

std::string whatIsMissing(const DeviceInfo& info) {
    std::string missing;
    for (const std::string& m : info.missing)
        missing += (missing.empty() ? "" : ", ") + m;
    return missing.empty() ? missing : info.name + " lacks " + missing;
}

bool hasExtension(const Functions& vk, VkPhysicalDevice physical, const char* name) {
    uint32_t count = 0;
    vk.EnumerateDeviceExtensionProperties(physical, nullptr, &count, nullptr);
    std::vector<VkExtensionProperties> extensions(count);
    vk.EnumerateDeviceExtensionProperties(physical, nullptr, &count, extensions.data());
    return std::ranges::any_of(
        extensions, [&](const VkExtensionProperties& e) { return std::strcmp(e.extensionName, name) == 0; });
}

}  // namespace ag::gpu
