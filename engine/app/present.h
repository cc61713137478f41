// A rendered image onto a window's, scaled to fit, with something drawn over it.
#pragma once

#include "engine/app/imgui_pass.h"
#include "engine/core/function_ref.h"
#include "engine/gpu/resources.h"
#include "engine/gpu/swapchain.h"

namespace ag {

// `from` is in TRANSFER_SRC_OPTIMAL; `drawOver` records with the target as a colour attachment.
void presentImage(const gpu::Functions& vk, VkCommandBuffer commands, const gpu::Image& from,
                  const gpu::SwapchainImage& target, glm::uvec2 size, FunctionRef<void()> drawOver);

// The same with the panels over it; `frame` picks their buffers.
void presentWithPanels(const gpu::Device& device, VkCommandBuffer commands, const gpu::Image& from,
                       const gpu::Swapchain& swapchain, const gpu::SwapchainImage& target, ImGuiPass& panels,
                       uint64_t frame);

}  // namespace ag
