#include "engine/app/present.h"

#include "engine/gpu/barrier.h"

namespace ag {
namespace {

void transition(const gpu::Functions& vk, VkCommandBuffer commands, VkImage image, VkImageLayout from,
                VkImageLayout to) {
    gpu::transitionImage(vk, commands, image, {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1}, from, to);
}

void blit(const gpu::Functions& vk, VkCommandBuffer commands, const gpu::Image& from, VkImage to,
          glm::uvec2 size) {
    VkImageBlit region{.srcSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                       .dstSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1}};
    region.srcOffsets[1] = {int32_t(from.desc().size.x), int32_t(from.desc().size.y), 1};
    region.dstOffsets[1] = {int32_t(size.x), int32_t(size.y), 1};
    vk.CmdBlitImage(commands, from.handle(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, to,
                    VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region, VK_FILTER_LINEAR);
}

}  // namespace

void presentImage(const gpu::Functions& vk, VkCommandBuffer commands, const gpu::Image& from,
                  const gpu::SwapchainImage& target, glm::uvec2 size, FunctionRef<void()> drawOver) {
    transition(vk, commands, target.image, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
    blit(vk, commands, from, target.image, size);
    transition(vk, commands, target.image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
               VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
    drawOver();
    transition(vk, commands, target.image, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
               VK_IMAGE_LAYOUT_PRESENT_SRC_KHR);
}

void presentWithPanels(const gpu::Device& device, VkCommandBuffer commands, const gpu::Image& from,
                       const gpu::Swapchain& swapchain, const gpu::SwapchainImage& target, ImGuiPass& panels,
                       uint64_t frame) {
    presentImage(device.vk(), commands, from, target, swapchain.size(), [&] {
        panels.draw(commands, target.view, swapchain.format(), swapchain.size(), uint32_t(frame % 2));
    });
}

}  // namespace ag
