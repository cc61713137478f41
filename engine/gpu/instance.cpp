#include "engine/gpu/instance.h"

#include <vulkan/vk_enum_string_helper.h>

#include <atomic>
#include <cstring>
#include <string>

#include "engine/core/log.h"
#include "engine/gpu/device_faults.h"

namespace ag::gpu {
namespace {

std::atomic<int> gValidationMessages{0};  // of the process: messages also arrive while a device is destroyed

// Older layers take no notice of timeline semaphores, by which our queues wait for each other
// (Vulkan-ValidationLayers, issue 7600): what they say of the work of two queues is not so. From 1.4 on they
// do.
constexpr uint32_t kFollowsTimelines = VK_MAKE_API_VERSION(0, 1, 4, 0);
std::atomic<uint32_t> gLayerVersion = kFollowsTimelines;  // messages arrive on any thread

bool isOfTwoQueues(const VkDebugUtilsMessengerCallbackDataEXT& data) {
    const std::string_view message = data.pMessage;
    const size_t prior = message.rfind("queue: VkQueue 0x");
    if (message.find("SYNC-HAZARD") == message.npos || prior == message.npos || data.objectCount == 0 ||
        data.pObjects[0].objectType != VK_OBJECT_TYPE_QUEUE)
        return false;
    return fmt::format("{:x}", data.pObjects[0].objectHandle) !=
           message.substr(prior + 17, message.find_first_not_of("0123456789abcdef", prior + 17) - prior - 17);
}

VKAPI_ATTR VkBool32 VKAPI_CALL onMessage(VkDebugUtilsMessageSeverityFlagBitsEXT severity,
                                         VkDebugUtilsMessageTypeFlagsEXT,
                                         const VkDebugUtilsMessengerCallbackDataEXT* data, void*) {
    if (severity >= VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT &&
        (gLayerVersion >= kFollowsTimelines || !isOfTwoQueues(*data))) {
        ++gValidationMessages;
        spdlog::error("validation: {}", data->pMessage);
    }
    return VK_FALSE;
}

// Of the Vulkan it was written for; 0: there is no such layer.
uint32_t versionOfLayer(const Functions& vk, const char* name) {
    uint32_t count = 0;
    vk.EnumerateInstanceLayerProperties(&count, nullptr);
    std::vector<VkLayerProperties> layers(count);
    vk.EnumerateInstanceLayerProperties(&count, layers.data());
    for (const VkLayerProperties& layer : layers)
        if (std::strcmp(layer.layerName, name) == 0) return layer.specVersion;
    return 0;
}

bool hasInstanceExtension(const Functions& vk, const char* name) {
    uint32_t count = 0;
    vk.EnumerateInstanceExtensionProperties(nullptr, &count, nullptr);
    std::vector<VkExtensionProperties> extensions(count);
    vk.EnumerateInstanceExtensionProperties(nullptr, &count, extensions.data());
    for (const VkExtensionProperties& extension : extensions)
        if (std::strcmp(extension.extensionName, name) == 0) return true;
    return false;
}

VkDebugUtilsMessengerCreateInfoEXT messengerInfo(const void* next) {
    return {.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT,
            .pNext = next,
            .messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT |
                               VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT,
            .messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT |
                           VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT,
            .pfnUserCallback = onMessage};
}

}  // namespace

Status openInstance(Functions& vk, std::vector<const char*> extensions, bool validate, Instance& instance) {
    const PFN_vkGetInstanceProcAddr loader = openLoader();
    if (!loader) return Error{"no Vulkan loader found (Debian package libvulkan1)"};
    loadGlobalFunctions(vk, loader);
    static constexpr const char* kLayer = "VK_LAYER_KHRONOS_validation";
    if (validate && (gLayerVersion = versionOfLayer(vk, kLayer)) == 0)
        return Error{
            "validation was asked for, but its layer is missing (Debian package vulkan-validationlayers)"};
    if (hasInstanceExtension(vk, VK_EXT_DEBUG_UTILS_EXTENSION_NAME))
        extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);

    const VkValidationFeatureEnableEXT synchronization =
        VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
    const VkValidationFeaturesEXT validation{.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT,
                                             .enabledValidationFeatureCount = 1,
                                             .pEnabledValidationFeatures = &synchronization};
    const VkDebugUtilsMessengerCreateInfoEXT messenging = messengerInfo(&validation);
    const VkApplicationInfo application{.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO,
                                        .pApplicationName = "Afterglow",
                                        .pEngineName = "Afterglow",
                                        .apiVersion = VK_API_VERSION_1_3};
    const VkInstanceCreateInfo info{.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
                                    .pNext = validate ? &messenging : nullptr,
                                    .pApplicationInfo = &application,
                                    .enabledLayerCount = validate ? 1u : 0u,
                                    .ppEnabledLayerNames = &kLayer,
                                    .enabledExtensionCount = uint32_t(extensions.size()),
                                    .ppEnabledExtensionNames = extensions.data()};
    if (const VkResult result = vk.CreateInstance(&info, nullptr, &instance.handle); result != VK_SUCCESS)
        return Error{std::string("cannot create a Vulkan instance: ") + string_VkResult(result)};
    loadInstanceFunctions(vk, instance.handle);
    if (validate) {
        const VkDebugUtilsMessengerCreateInfoEXT own = messengerInfo(nullptr);
        AG_VK(vk.CreateDebugUtilsMessengerEXT(instance.handle, &own, nullptr, &instance.messenger));
    }
    return Ok{};
}

void closeInstance(const Functions& vk, const Instance& instance) {
    if (instance.messenger) vk.DestroyDebugUtilsMessengerEXT(instance.handle, instance.messenger, nullptr);
    if (instance.handle) vk.DestroyInstance(instance.handle, nullptr);
}

int totalValidationMessages() {
    return gValidationMessages;
}

}  // namespace ag::gpu
