// Whole-pipeline image barriers for code outside the frame graph: transfers and presenting.
#pragma once

#include "engine/gpu/functions.h"

namespace ag::gpu {

// Everything before is done and visible to everything after.
void fullBarrier(const Functions& vk, VkCommandBuffer commands);
// The same, and the subresources change layout.
void transitionImage(const Functions& vk, VkCommandBuffer commands, VkImage image,
                     const VkImageSubresourceRange& range, VkImageLayout from, VkImageLayout to);

}  // namespace ag::gpu
