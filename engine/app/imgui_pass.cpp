#include "engine/app/imgui_pass.h"

#include <imgui.h>

#include <algorithm>
#include <cstring>

#include "engine/gpu/transfer.h"

namespace ag {
namespace {

gpu::PipelineRequest panelPipeline(VkFormat format) {
    gpu::PipelineRequest request;
    request.vertexShader = "imgui/panel.vert";
    request.fragmentShader = "imgui/panel.frag";
    request.raster.vertexLayout = gpu::VertexLayout::kImGui;
    request.raster.blend = gpu::BlendMode::kAlpha;
    request.raster.colorFormats[0] = format;
    request.raster.colorCount = 1;
    return request;
}

std::unique_ptr<gpu::Buffer> grown(gpu::Device& device, std::unique_ptr<gpu::Buffer> old, const char* name,
                                   uint64_t bytes) {
    if (old && old->sizeBytes() >= bytes) return old;
    return std::make_unique<gpu::Buffer>(
        device,
        gpu::BufferDesc{.name = name, .sizeBytes = bytes * 2, .hostVisible = true, .vertexOrIndex = true});
}

VkRect2D clipped(const ImVec4& clip, glm::uvec2 size) {
    const int32_t x0 = std::clamp(int32_t(clip.x), 0, int32_t(size.x)),
                  y0 = std::clamp(int32_t(clip.y), 0, int32_t(size.y));
    const int32_t x1 = std::clamp(int32_t(clip.z), x0, int32_t(size.x)),
                  y1 = std::clamp(int32_t(clip.w), y0, int32_t(size.y));
    return {{x0, y0}, {uint32_t(x1 - x0), uint32_t(y1 - y0)}};
}

}  // namespace

ImGuiPass::ImGuiPass(gpu::Device& device) : device_(device) {
    unsigned char* texels = nullptr;
    int width = 0, height = 0;
    ImGui::GetIO().Fonts->GetTexDataAsRGBA32(&texels, &width, &height);
    font_ = std::make_unique<gpu::Image>(
        device,
        gpu::ImageDesc{.name = "imgui.font", .format = VK_FORMAT_R8G8B8A8_UNORM, .size = {width, height}});
    gpu::uploadImage(device, *font_, 0, std::as_bytes(std::span(texels, size_t(width) * size_t(height) * 4)));
    const VkSamplerCreateInfo sampler{.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO,
                                      .magFilter = VK_FILTER_LINEAR,
                                      .minFilter = VK_FILTER_LINEAR};
    AG_VK(device.vk().CreateSampler(device.handle(), &sampler, nullptr, &sampler_));
    device.context().setDebugName(VK_OBJECT_TYPE_SAMPLER, sampler_, "imgui.sampler");
    const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1};
    const VkDescriptorPoolCreateInfo pool{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                                          .maxSets = 1,
                                          .poolSizeCount = 1,
                                          .pPoolSizes = &size};
    AG_VK(device.vk().CreateDescriptorPool(device.handle(), &pool, nullptr, &pool_));
    device.context().setDebugName(VK_OBJECT_TYPE_DESCRIPTOR_POOL, pool_, "imgui.sets");
}

ImGuiPass::~ImGuiPass() {
    device_.waitIdle();
    device_.vk().DestroyDescriptorPool(device_.handle(), pool_, nullptr);
    device_.vk().DestroySampler(device_.handle(), sampler_, nullptr);
}

void ImGuiPass::upload(Buffers& buffers) {
    const ImDrawData& data = *ImGui::GetDrawData();
    buffers.vertices = grown(device_, std::move(buffers.vertices), "imgui.vertices",
                             uint64_t(data.TotalVtxCount) * sizeof(ImDrawVert));
    buffers.indices = grown(device_, std::move(buffers.indices), "imgui.indices",
                            uint64_t(data.TotalIdxCount) * sizeof(ImDrawIdx));
    std::byte* vertex = buffers.vertices->mapped();
    std::byte* index = buffers.indices->mapped();
    for (int i = 0; i < data.CmdListsCount; ++i) {
        const ImDrawList& list = *data.CmdLists[i];
        std::memcpy(vertex, list.VtxBuffer.Data, size_t(list.VtxBuffer.size_in_bytes()));
        std::memcpy(index, list.IdxBuffer.Data, size_t(list.IdxBuffer.size_in_bytes()));
        vertex += list.VtxBuffer.size_in_bytes();
        index += list.IdxBuffer.size_in_bytes();
    }
}

void ImGuiPass::makeFontSet(VkDescriptorSetLayout layout) {
    const VkDescriptorSetAllocateInfo info{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
                                           .descriptorPool = pool_,
                                           .descriptorSetCount = 1,
                                           .pSetLayouts = &layout};
    AG_VK(device_.vk().AllocateDescriptorSets(device_.handle(), &info, &set_));
    device_.context().setDebugName(VK_OBJECT_TYPE_DESCRIPTOR_SET, set_, "imgui.font");
    const VkDescriptorImageInfo image{sampler_, font_->view(), VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
    const VkWriteDescriptorSet write{.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                                     .dstSet = set_,
                                     .descriptorCount = 1,
                                     .descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
                                     .pImageInfo = &image};
    device_.vk().UpdateDescriptorSets(device_.handle(), 1, &write, 0, nullptr);
}

void ImGuiPass::bind(VkCommandBuffer commands, const gpu::Pipeline& pipeline, const Buffers& buffers) {
    device_.vk().CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.handle);
    device_.vk().CmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.layout, 0, 1,
                                       &set_, 0, nullptr);
    const VkBuffer vertices = buffers.vertices->handle();
    const VkDeviceSize zero = 0;
    device_.vk().CmdBindVertexBuffers(commands, 0, 1, &vertices, &zero);
    device_.vk().CmdBindIndexBuffer(commands, buffers.indices->handle(), 0,
                                    sizeof(ImDrawIdx) == 2 ? VK_INDEX_TYPE_UINT16 : VK_INDEX_TYPE_UINT32);
    const ImDrawData& data = *ImGui::GetDrawData();
    const glm::vec2 scale(2 / data.DisplaySize.x, 2 / data.DisplaySize.y);
    const glm::vec2 push[] = {scale, glm::vec2(-1) - glm::vec2(data.DisplayPos.x, data.DisplayPos.y) * scale};
    device_.vk().CmdPushConstants(commands, pipeline.layout, pipeline.pushStages, 0, sizeof push, push);
}

void ImGuiPass::drawLists(VkCommandBuffer commands, glm::uvec2 size) {
    const VkViewport viewport{0, 0, float(size.x), float(size.y), 0, 1};
    device_.vk().CmdSetViewport(commands, 0, 1, &viewport);
    const ImDrawData& data = *ImGui::GetDrawData();
    int32_t firstVertex = 0;
    uint32_t firstIndex = 0;
    for (int i = 0; i < data.CmdListsCount; ++i) {
        const ImDrawList& list = *data.CmdLists[i];
        for (const ImDrawCmd& command : list.CmdBuffer) {
            const VkRect2D scissor = clipped(command.ClipRect, size);
            if (scissor.extent.width == 0 || scissor.extent.height == 0) continue;
            device_.vk().CmdSetScissor(commands, 0, 1, &scissor);
            device_.vk().CmdDrawIndexed(commands, command.ElemCount, 1, firstIndex + command.IdxOffset,
                                        firstVertex + int32_t(command.VtxOffset), 0);
        }
        firstVertex += list.VtxBuffer.Size;
        firstIndex += uint32_t(list.IdxBuffer.Size);
    }
}

void ImGuiPass::draw(VkCommandBuffer commands, VkImageView target, VkFormat format, glm::uvec2 size,
                     uint32_t slot) {
    const ImDrawData* data = ImGui::GetDrawData();
    if (!data || data->TotalVtxCount == 0) return;
    Buffers& buffers = buffers_[slot % buffers_.size()];
    upload(buffers);
    const gpu::Pipeline& pipeline = device_.pipelines().get(panelPipeline(format));
    if (!set_) makeFontSet(pipeline.setLayout);
    const VkRenderingAttachmentInfo color{.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
                                          .imageView = target,
                                          .imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                                          .loadOp = VK_ATTACHMENT_LOAD_OP_LOAD,
                                          .storeOp = VK_ATTACHMENT_STORE_OP_STORE};
    const VkRenderingInfo rendering{.sType = VK_STRUCTURE_TYPE_RENDERING_INFO,
                                    .renderArea = {{0, 0}, {size.x, size.y}},
                                    .layerCount = 1,
                                    .colorAttachmentCount = 1,
                                    .pColorAttachments = &color};
    device_.vk().CmdBeginRendering(commands, &rendering);
    bind(commands, pipeline, buffers);
    drawLists(commands, size);
    device_.vk().CmdEndRendering(commands);
}

}  // namespace ag
