// A rendered image onto a window's, scaled to fit, with something drawn over it.
#pragma once

#include "engine/core/function_ref.h"
#include "engine/gpu/resources.h"
#include "engine/gpu/swapchain.h"

namespace ag::game {

// `from` is in TRANSFER_SRC_OPTIMAL; `drawOver` records with the target as a colour attachment.
void presentImage(const gpu::Functions& vk, VkCommandBuffer commands, const gpu::Image& from,
                  const gpu::SwapchainImage& target, glm::uvec2 size, FunctionRef<void()> drawOver);

}  // namespace ag::game
