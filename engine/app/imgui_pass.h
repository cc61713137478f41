// Draws Dear ImGui's lists over an image, with dynamic rendering: one pipeline, one font texture.
#pragma once

#include <array>
#include <memory>

#include "engine/gpu/device.h"
#include "engine/gpu/pipeline.h"
#include "engine/gpu/resources.h"

namespace ag {

class ImGuiPass {
  public:
    // An ImGui context must exist; its font atlas is uploaded now.
    explicit ImGuiPass(gpu::Device& device);
    ~ImGuiPass();
    ImGuiPass(const ImGuiPass&) = delete;
    ImGuiPass& operator=(const ImGuiPass&) = delete;

    // Inside no rendering; `target` is in COLOR_ATTACHMENT_OPTIMAL. Slots alternate between frames in flight.
    void draw(VkCommandBuffer commands, VkImageView target, VkFormat format, glm::uvec2 size, uint32_t slot);

  private:
    struct Buffers {
        std::unique_ptr<gpu::Buffer> vertices, indices;
    };
    void upload(Buffers& buffers);
    void makeFontSet(VkDescriptorSetLayout layout);
    void bind(VkCommandBuffer commands, const gpu::Pipeline& pipeline, const Buffers& buffers);
    void drawLists(VkCommandBuffer commands, glm::uvec2 size);

    gpu::Device& device_;
    std::unique_ptr<gpu::Image> font_;
    VkSampler sampler_ = VK_NULL_HANDLE;
    VkDescriptorPool pool_ = VK_NULL_HANDLE;
    VkDescriptorSet set_ = VK_NULL_HANDLE;
    std::array<Buffers, 2> buffers_;
};

}  // namespace ag
