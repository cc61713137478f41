// Names of Vulkan objects, as validation messages and RenderDoc show them.
#pragma once

#include "engine/gpu/functions.h"

#include <cstdint>
#include <string>

namespace ag::gpu {

// Nothing where VK_EXT_debug_utils is not there.
template <class Handle>
void setDebugName(const Functions& vk, VkDevice device, VkObjectType type, Handle handle,
                  const std::string& name) {
    if (!vk.SetDebugUtilsObjectNameEXT || name.empty()) return;
    const VkDebugUtilsObjectNameInfoEXT info{.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT,
                                             .objectType = type,
                                             .objectHandle = uint64_t(handle),
                                             .pObjectName = name.c_str()};
    vk.SetDebugUtilsObjectNameEXT(device, &info);
}

}  // namespace ag::gpu
