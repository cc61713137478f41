#include "engine/gpu/transfer.h"

#include <algorithm>
#include <cstring>
#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <vector>

#include "engine/gpu/barrier.h"

namespace ag::gpu {
namespace {

void barrier(const Device& device, VkCommandBuffer commands, const Image& image,
             const VkImageSubresourceRange& levels, VkImageLayout from, VkImageLayout to) {
    transitionImage(device.vk(), commands, image.handle(), levels, from, to);
}

VkImageSubresourceRange allLevels(const Image& image, uint32_t layer) {
    return {image.aspect(), 0, image.desc().mips, layer, 1};
}

VkImageSubresourceRange oneLevel(const Image& image, uint32_t layer, uint32_t mip) {
    return {image.aspect(), mip, 1, layer, 1};
}

// Where each mip of one layer lies in tightly packed texels; their size in bytes.
uint64_t listMips(const Image& image, uint32_t layer, std::vector<VkBufferImageCopy>& regions) {
    const ImageDesc& desc = image.desc();
    uint64_t bytes = 0;
    for (uint32_t mip = 0; mip < desc.mips; ++mip) {
        const glm::uvec2 size = glm::max(desc.size >> mip, 1u);
        regions.push_back({.bufferOffset = bytes,
                           .imageSubresource = {image.aspect(), mip, layer, 1},
                           .imageExtent = {size.x, size.y, 1}});
        bytes += uint64_t(size.x) * size.y * texelSizeBytes(desc.format);
    }
    return bytes;
}

}  // namespace

void uploadBuffer(Device& device, Buffer& buffer, std::span<const std::byte> bytes, uint64_t offset) {
    if (bytes.empty()) return;
    Buffer staging(device, {.name = "transfer.upload", .sizeBytes = bytes.size(), .hostVisible = true});
    std::memcpy(staging.mapped(), bytes.data(), bytes.size());
    device.runOnce([&](VkCommandBuffer commands) {
        const VkBufferCopy region{.dstOffset = offset, .size = bytes.size()};
        device.vk().CmdCopyBuffer(commands, staging.handle(), buffer.handle(), 1, &region);
    });
}

void downloadBuffer(Device& device, const Buffer& buffer, std::span<std::byte> bytes, uint64_t offset) {
    Buffer staging(device, {.name = "transfer.download", .sizeBytes = bytes.size(), .hostVisible = true});
    device.runOnce([&](VkCommandBuffer commands) {
        const VkMemoryBarrier2 written{.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2,
                                       .srcStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                                       .srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT,
                                       .dstStageMask = VK_PIPELINE_STAGE_2_COPY_BIT,
                                       .dstAccessMask = VK_ACCESS_2_TRANSFER_READ_BIT};
        const VkDependencyInfo info{
            .sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO, .memoryBarrierCount = 1, .pMemoryBarriers = &written};
        device.vk().CmdPipelineBarrier2(commands, &info);
        const VkBufferCopy region{.srcOffset = offset, .size = bytes.size()};
        device.vk().CmdCopyBuffer(commands, buffer.handle(), staging.handle(), 1, &region);
    });
    std::memcpy(bytes.data(), staging.mapped(), bytes.size());
}

void uploadImage(Device& device, Image& image, uint32_t layer, std::span<const std::byte> texels) {
    std::vector<VkBufferImageCopy> mips;
    AG_CHECK_EQ(texels.size(), listMips(image, layer, mips));
    Buffer staging(device, {.name = "transfer.upload", .sizeBytes = texels.size(), .hostVisible = true});
    std::memcpy(staging.mapped(), texels.data(), texels.size());
    device.runOnce([&](VkCommandBuffer commands) {
        barrier(device, commands, image, allLevels(image, layer), VK_IMAGE_LAYOUT_UNDEFINED,
                VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
        device.vk().CmdCopyBufferToImage(commands, staging.handle(), image.handle(),
                                         VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, uint32_t(mips.size()),
                                         mips.data());
        barrier(device, commands, image, allLevels(image, layer), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    });
}

void downloadImage(Device& device, const Image& image, VkImageLayout layout, std::span<std::byte> texels) {
    const ImageDesc& desc = image.desc();
    AG_CHECK_EQ(texels.size(), size_t(desc.size.x) * desc.size.y * texelSizeBytes(desc.format));
    Buffer staging(device, {.name = "transfer.download", .sizeBytes = texels.size(), .hostVisible = true});
    device.runOnce([&](VkCommandBuffer commands) {
        barrier(device, commands, image, oneLevel(image, 0, 0), layout, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
        const VkBufferImageCopy region{.imageSubresource = {image.aspect(), 0, 0, 1},
                                       .imageExtent = {desc.size.x, desc.size.y, 1}};
        device.vk().CmdCopyImageToBuffer(commands, image.handle(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                                         staging.handle(), 1, &region);
        barrier(device, commands, image, oneLevel(image, 0, 0), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, layout);
    });
    std::memcpy(texels.data(), staging.mapped(), texels.size());
}

}  // namespace ag::gpu
