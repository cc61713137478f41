#include "engine/gpu/functions.h"

#include <dlfcn.h>

#include <type_traits>

namespace ag::gpu {

void loadGlobalFunctions(Functions& vk, PFN_vkGetInstanceProcAddr getInstanceProcAddr) {
    vk.GetInstanceProcAddr = getInstanceProcAddr;
#define X(name) vk.name = PFN_vk##name(getInstanceProcAddr(VK_NULL_HANDLE, "vk" #name));
    AG_VULKAN_GLOBAL_FUNCTIONS(X)
#undef X
}

void loadInstanceFunctions(Functions& vk, VkInstance instance) {
#define X(name) vk.name = PFN_vk##name(vk.GetInstanceProcAddr(instance, "vk" #name));
    AG_VULKAN_INSTANCE_FUNCTIONS(X)
#undef X
}

void loadDeviceFunctions(Functions& vk, VkDevice device) {
#define X(name) vk.name = PFN_vk##name(vk.GetDeviceProcAddr(device, "vk" #name));
    AG_VULKAN_DEVICE_FUNCTIONS(X)
#undef X
    // Of a device that has these as extensions only.
    const auto orExtension = [&](auto& function, const char* name) {
        using Pointer = std::remove_reference_t<decltype(function)>;
        if (!function) function = Pointer(vk.GetDeviceProcAddr(device, name));
    };
    orExtension(vk.CmdBindVertexBuffers2, "vkCmdBindVertexBuffers2EXT");
    orExtension(vk.CmdSetFrontFace, "vkCmdSetFrontFaceEXT");
    orExtension(vk.CmdBeginRendering, "vkCmdBeginRenderingKHR");
    orExtension(vk.CmdEndRendering, "vkCmdEndRenderingKHR");
    orExtension(vk.CmdPipelineBarrier2, "vkCmdPipelineBarrier2KHR");
    orExtension(vk.CmdWriteTimestamp2, "vkCmdWriteTimestamp2KHR");
    orExtension(vk.QueueSubmit2, "vkQueueSubmit2KHR");
}

PFN_vkGetInstanceProcAddr openLoader() {
    static void* const library = dlopen("libvulkan.so.1", RTLD_NOW | RTLD_LOCAL);
    return library ? PFN_vkGetInstanceProcAddr(dlsym(library, "vkGetInstanceProcAddr")) : nullptr;
}

}  // namespace ag::gpu
