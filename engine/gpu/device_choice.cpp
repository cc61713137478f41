#include "engine/gpu/device_choice.h"

#include <algorithm>
#include <optional>

#include "engine/core/number.h"

namespace ag::gpu {
namespace {

std::vector<VkQueueFamilyProperties> queueFamilies(const Functions& vk, VkPhysicalDevice physical) {
    uint32_t count = 0;
    vk.GetPhysicalDeviceQueueFamilyProperties(physical, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vk.GetPhysicalDeviceQueueFamilyProperties(physical, &count, families.data());
    return families;
}

std::optional<uint32_t> findQueueFamily(const Functions& vk, VkPhysicalDevice physical,
                                        VkSurfaceKHR surface) {
    const std::vector<VkQueueFamilyProperties> families = queueFamilies(vk, physical);
    for (uint32_t i = 0; i < families.size(); ++i) {
        constexpr VkQueueFlags kNeeded = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
        VkBool32 presents = surface == VK_NULL_HANDLE;
        if (surface) vk.GetPhysicalDeviceSurfaceSupportKHR(physical, i, surface, &presents);
        if ((families[i].queueFlags & kNeeded) == kNeeded && presents) return i;
    }
    return std::nullopt;
}

// A family for compute alone, which graphics do not hold up; else a second queue of the main one. It must
// have timestamps. kAlone: the main queue again.
void chooseAsyncQueue(const Functions& vk, AsyncQueue mode, DeviceChoice& choice) {
    if (mode == AsyncQueue::kOff) return;
    const std::vector<VkQueueFamilyProperties> families = queueFamilies(vk, choice.physical);
    const auto isCompute = [](const VkQueueFamilyProperties& f) {
        return (f.queueFlags & VK_QUEUE_COMPUTE_BIT) && !(f.queueFlags & VK_QUEUE_GRAPHICS_BIT) &&
               f.timestampValidBits > 0;
    };
    const auto compute = std::ranges::find_if(families, isCompute);
    if (mode == AsyncQueue::kAlone) {
        choice.asyncFamily = choice.queueFamily;
    } else if (compute != families.end()) {
        choice.asyncFamily = uint32_t(compute - families.begin());
    } else if (families[choice.queueFamily].queueCount > 1) {
        choice.asyncFamily = choice.queueFamily;
        choice.asyncIndex = 1;
    }
}

// Whether its timestamps can be put on the clock of the host's spans; done without where not.
bool sharesClock(const Functions& vk, VkPhysicalDevice physical) {
    if (!hasExtension(vk, physical, VK_EXT_CALIBRATED_TIMESTAMPS_EXTENSION_NAME)) return false;
    uint32_t count = 0;
    vk.GetPhysicalDeviceCalibrateableTimeDomainsEXT(physical, &count, nullptr);
    std::vector<VkTimeDomainEXT> domains(count);
    vk.GetPhysicalDeviceCalibrateableTimeDomainsEXT(physical, &count, domains.data());
    return std::ranges::count(domains, VK_TIME_DOMAIN_DEVICE_EXT) > 0 &&
           std::ranges::count(domains, VK_TIME_DOMAIN_CLOCK_MONOTONIC_EXT) > 0;
}

// Done without where they are lacking.
constexpr const char *kTimestamps = "timestamps", *kAnisotropy = "samplerAnisotropy";

bool isFeature(std::string_view name) {
    return name == kTimestamps || name == kAnisotropy || name == kSubgroupOperations ||
           std::ranges::any_of(requiredFeatures(), [&](const RequiredFeature& f) { return name == f.name; });
}

std::string knownNames() {
    std::string names = std::string(kTimestamps) + ", " + kAnisotropy + ", " + kSubgroupOperations;
    for (const RequiredFeature& f : requiredFeatures())
        names += std::string(", ") + f.name;
    for (const DeviceLimit& limit : deviceLimits())
        names += ", " + std::string(limit.name) + "=N";
    return names;
}

struct Without {
    std::vector<std::string> features;
    std::vector<LoweredLimit> limits;
};

// Names of features, and LIMIT=N.
Result<Without> parseWithout(std::span<const std::string> texts) {
    Without without;
    for (const std::string& text : texts) {
        const size_t equals = text.find('=');
        const DeviceLimit* limit =
            equals == std::string::npos ? nullptr : findDeviceLimit(text.substr(0, equals));
        if (!limit && !isFeature(text))
            return Error{"there is no feature or limit '" + text +
                         "' to do without (there are: " + knownNames() + ")"};
        if (!limit) {
            without.features.push_back(text);
            continue;
        }
        const auto most = parseNumber(text.substr(equals + 1), 0, double(UINT32_MAX), true);
        if (!most) return Error{"'" + text + "' gives the limit no whole number from 0 to 4294967295"};
        without.limits.push_back({limit, uint32_t(*most)});
    }
    return without;
}

void leaveOut(std::span<const std::string> features, DeviceInfo& info) {
    for (const std::string& name : features) {
        if (name == kTimestamps)
            info.timestampPeriodNs = 0;  // passes then have no times of their own
        else if (name == kAnisotropy)
            info.mostAnisotropy = 1;
        else if (std::erase(info.enabled, name) > 0)
            info.missing.push_back(name);
    }
}

int score(const Functions& vk, VkPhysicalDevice physical, const DeviceInfo& info,
          const std::string& preferredName) {
    VkPhysicalDeviceProperties properties;
    vk.GetPhysicalDeviceProperties(physical, &properties);
    int points = 1;
    if (properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU) points = 3;
    if (properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU) points = 2;
    if (!preferredName.empty() && info.name.find(preferredName) != std::string::npos) points += 10;
    return points;
}

}  // namespace

Result<DeviceChoice> chooseDevice(const Functions& vk, VkInstance instance, VkSurfaceKHR surface,
                                  const DeviceOptions& options) {
    const auto less = parseWithout(options.without);
    if (!less) return less.error();
    uint32_t count = 0;
    vk.EnumeratePhysicalDevices(instance, &count, nullptr);
    std::vector<VkPhysicalDevice> devices(count);
    vk.EnumeratePhysicalDevices(instance, &count, devices.data());
    DeviceChoice best;
    int bestScore = 0;
    std::string lacks;
    for (VkPhysicalDevice physical : devices) {
        DeviceChoice choice{.physical = physical, .info = describeDevice(vk, physical, less->limits)};
        leaveOut(less->features, choice.info);
        if (options.gpuKernels) choice.info.isCpu = false;
        if (options.sharedLanes) choice.info.lanes = {.count = options.sharedLanes, .shared = true};
        const auto family = findQueueFamily(vk, physical, surface);
        if (!family) choice.info.missing.push_back("a queue for graphics, compute and presenting");
        if (!choice.info.missing.empty()) {
            lacks += " " + whatIsMissing(choice.info) + ";";
            continue;
        }
        choice.queueFamily = *family;
        if (const int points = score(vk, physical, choice.info, options.deviceName); points > bestScore) {
            bestScore = points;
            best = std::move(choice);
        }
    }
    if (bestScore > 0) {
        chooseAsyncQueue(vk, options.asyncQueue, best);
        best.info.calibrated = sharesClock(vk, best.physical);
        if (best.info.calibrated) best.info.enabled.push_back(VK_EXT_CALIBRATED_TIMESTAMPS_EXTENSION_NAME);
        return best;
    }
    if (devices.empty())
        return Error{"no Vulkan device found (on Debian, mesa-vulkan-drivers brings a software device)"};
    return Error{"no usable Vulkan 1.3 device:" + lacks};
}

Result<VkDevice> openDevice(const Functions& vk, const DeviceChoice& choice, bool withSwapchain) {
    DeviceFeatures features;
    enable(features, choice.info);
    const float priorities[] = {1, 1};
    const bool otherFamily = choice.asyncFamily && *choice.asyncFamily != choice.queueFamily;
    const VkDeviceQueueCreateInfo queues[] = {{.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
                                               .queueFamilyIndex = choice.queueFamily,
                                               .queueCount = 1 + choice.asyncIndex,
                                               .pQueuePriorities = priorities},
                                              {.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
                                               .queueFamilyIndex = choice.asyncFamily.value_or(0),
                                               .queueCount = 1,
                                               .pQueuePriorities = priorities}};
    std::vector<const char*> extensions;
    if (withSwapchain) extensions.push_back(VK_KHR_SWAPCHAIN_EXTENSION_NAME);
    if (choice.info.apiVersion < VK_API_VERSION_1_3)
        extensions.insert(extensions.end(), extensionsOf13().begin(), extensionsOf13().end());
    if (choice.info.calibrated) extensions.push_back(VK_EXT_CALIBRATED_TIMESTAMPS_EXTENSION_NAME);
    const VkDeviceCreateInfo info{.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                                  .pNext = &features.core,
                                  .queueCreateInfoCount = otherFamily ? 2u : 1u,
                                  .pQueueCreateInfos = queues,
                                  .enabledExtensionCount = uint32_t(extensions.size()),
                                  .ppEnabledExtensionNames = extensions.data()};
    VkDevice device = VK_NULL_HANDLE;
    const VkResult result = vk.CreateDevice(choice.physical, &info, nullptr, &device);
    if (result != VK_SUCCESS)
        return Error{"cannot open " + choice.info.name + " (Vulkan error " + std::to_string(result) + ")"};
    return device;
}

}  // namespace ag::gpu
