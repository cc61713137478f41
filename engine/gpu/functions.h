// Vulkan's functions, loaded for one instance and one device: no global state, so that contexts of several
// hosts live side by side in a process. What is called is listed here.
#pragma once

#ifndef VK_NO_PROTOTYPES
#define VK_NO_PROTOTYPES
#endif
#include <vulkan/vulkan_core.h>

namespace ag::gpu {

// clang-format off
#define AG_VULKAN_GLOBAL_FUNCTIONS(X) \
    X(CreateInstance) X(EnumerateInstanceExtensionProperties) X(EnumerateInstanceLayerProperties)

#define AG_VULKAN_INSTANCE_FUNCTIONS(X) \
    X(CreateDebugUtilsMessengerEXT) X(CreateDevice) X(DestroyDebugUtilsMessengerEXT) X(DestroyInstance) \
    X(DestroySurfaceKHR) X(EnumerateDeviceExtensionProperties) X(EnumeratePhysicalDevices) \
    X(GetDeviceProcAddr) X(GetPhysicalDeviceCalibrateableTimeDomainsEXT) X(GetPhysicalDeviceFeatures2) \
    X(GetPhysicalDeviceFormatProperties) X(GetPhysicalDeviceMemoryProperties) \
    X(GetPhysicalDeviceProperties) X(GetPhysicalDeviceProperties2) \
    X(GetPhysicalDeviceQueueFamilyProperties) X(GetPhysicalDeviceSurfaceCapabilitiesKHR) \
    X(GetPhysicalDeviceSurfaceFormatsKHR) X(GetPhysicalDeviceSurfacePresentModesKHR) \
    X(GetPhysicalDeviceSurfaceSupportKHR)

#define AG_VULKAN_DEVICE_FUNCTIONS(X) \
    X(AcquireNextImageKHR) X(AllocateCommandBuffers) X(AllocateDescriptorSets) X(AllocateMemory) \
    X(BeginCommandBuffer) X(BindBufferMemory) X(BindImageMemory) X(CmdBeginDebugUtilsLabelEXT) \
    X(CmdBeginQuery) X(CmdBeginRendering) X(CmdBindDescriptorSets) X(CmdBindIndexBuffer) \
    X(CmdBindPipeline) X(CmdBindVertexBuffers) X(CmdBindVertexBuffers2) X(CmdBlitImage) X(CmdClearAttachments) \
    X(CmdClearColorImage) X(CmdCopyBuffer) X(CmdCopyBufferToImage) X(CmdCopyImage) X(CmdCopyImageToBuffer) \
    X(CmdCopyQueryPoolResults) X(CmdDispatch) X(CmdDispatchIndirect) X(CmdDraw) X(CmdDrawIndexed) \
    X(CmdDrawIndexedIndirect) X(CmdEndDebugUtilsLabelEXT) X(CmdEndQuery) X(CmdEndRendering) \
    X(CmdFillBuffer) X(CmdPipelineBarrier2) X(CmdPushConstants) X(CmdResetQueryPool) X(CmdSetFrontFace) \
    X(CmdSetScissor) X(CmdSetViewport) X(CmdUpdateBuffer) X(CmdWriteTimestamp2) X(CreateBuffer) X(CreateBufferView) \
    X(CreateCommandPool) X(CreateComputePipelines) X(CreateDescriptorPool) X(CreateDescriptorSetLayout) \
    X(CreateGraphicsPipelines) X(CreateImage) X(CreateImageView) X(CreatePipelineCache) \
    X(CreatePipelineLayout) X(CreateQueryPool) X(CreateSampler) X(CreateSemaphore) X(CreateShaderModule) \
    X(CreateSwapchainKHR) X(DestroyBuffer) X(DestroyBufferView) X(DestroyCommandPool) \
    X(DestroyDescriptorPool) X(DestroyDescriptorSetLayout) X(DestroyDevice) X(DestroyImage) \
    X(DestroyImageView) X(DestroyPipeline) X(DestroyPipelineCache) X(DestroyPipelineLayout) \
    X(DestroyQueryPool) X(DestroySampler) X(DestroySemaphore) X(DestroyShaderModule) \
    X(DestroySwapchainKHR) X(DeviceWaitIdle) X(EndCommandBuffer) X(FreeCommandBuffers) X(FreeMemory) \
    X(GetBufferMemoryRequirements) X(GetCalibratedTimestampsEXT) X(GetDeviceQueue) \
    X(GetImageMemoryRequirements) X(GetPipelineCacheData) X(GetQueryPoolResults) \
    X(GetSemaphoreCounterValue) X(GetSwapchainImagesKHR) X(MapMemory) X(QueuePresentKHR) X(QueueSubmit2) \
    X(QueueWaitIdle) X(ResetCommandPool) X(ResetQueryPool) X(SetDebugUtilsObjectNameEXT) \
    X(UpdateDescriptorSets) X(WaitSemaphores)
// clang-format on

// Null: the driver does not have it.
struct Functions {
#define X(name) PFN_vk##name name = nullptr;
    AG_VULKAN_GLOBAL_FUNCTIONS(X)
    AG_VULKAN_INSTANCE_FUNCTIONS(X)
    AG_VULKAN_DEVICE_FUNCTIONS(X)
#undef X
    PFN_vkGetInstanceProcAddr GetInstanceProcAddr = nullptr;
};

// In this order; each needs the one before.
void loadGlobalFunctions(Functions& vk, PFN_vkGetInstanceProcAddr getInstanceProcAddr);
void loadInstanceFunctions(Functions& vk, VkInstance instance);
void loadDeviceFunctions(Functions& vk, VkDevice device);

// Of the machine's Vulkan loader, opened once and kept; null where there is none.
PFN_vkGetInstanceProcAddr openLoader();

}  // namespace ag::gpu
