// Whole-pipeline image barriers for code outside the frame graph: transfers and presenting.
#pragma once

#include <volk.h>

namespace ag::gpu {

// Everything before is done and visible to everything after; the subresources change layout.
void transitionImage(VkCommandBuffer commands, VkImage image, const VkImageSubresourceRange& range,
                     VkImageLayout from, VkImageLayout to);

}  // namespace ag::gpu
