// A loader as a host hands it over, behind which Vulkan fails when a test says so.
#pragma once

#include <vulkan/vulkan_core.h>

namespace ag::test {

// Of the functions that make, allocate, bind or map: the one after `count` more returns `result`; from then
// on VK_ERROR_DEVICE_LOST is returned by all of them, any other result by that one alone.
void failVulkanAfter(int count, VkResult result);
void vulkanWorks();
int countedVulkanCalls();  // since either

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL faultyGetInstanceProcAddr(VkInstance instance, const char* name);

}  // namespace ag::test
