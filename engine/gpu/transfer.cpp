#include "engine/gpu/transfer.h"

#include <algorithm>
#include <cstring>

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

VkOffset3D mipEnd(const ImageDesc& desc, uint32_t mip) {
    return {int32_t(std::max(desc.size.x >> mip, 1u)), int32_t(std::max(desc.size.y >> mip, 1u)), 1};
}

// Mip 0 is in TRANSFER_DST; every level ends in SHADER_READ_ONLY.
void blitMips(const Device& device, VkCommandBuffer commands, const Image& image, uint32_t layer) {
    const ImageDesc& desc = image.desc();
    for (uint32_t mip = 1; mip < desc.mips; ++mip) {
        barrier(device, commands, image, oneLevel(image, layer, mip - 1),
                VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
        VkImageBlit region{.srcSubresource = {image.aspect(), mip - 1, layer, 1},
                           .dstSubresource = {image.aspect(), mip, layer, 1}};
        region.srcOffsets[1] = mipEnd(desc, mip - 1);
        region.dstOffsets[1] = mipEnd(desc, mip);
        device.vk().CmdBlitImage(commands, image.handle(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                                 image.handle(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region,
                                 VK_FILTER_LINEAR);
        barrier(device, commands, image, oneLevel(image, layer, mip - 1),
                VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    }
    barrier(device, commands, image, oneLevel(image, layer, desc.mips - 1),
            VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
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

void uploadImage(Device& device, Image& image, uint32_t layer, std::span<const std::byte> texels,
                 bool makeMips) {
    const ImageDesc& desc = image.desc();
    AG_CHECK_EQ(texels.size(), size_t(desc.size.x) * desc.size.y * texelSizeBytes(desc.format));
    Buffer staging(device, {.name = "transfer.upload", .sizeBytes = texels.size(), .hostVisible = true});
    std::memcpy(staging.mapped(), texels.data(), texels.size());
    device.runOnce([&](VkCommandBuffer commands) {
        barrier(device, commands, image, allLevels(image, layer), VK_IMAGE_LAYOUT_UNDEFINED,
                VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
        const VkBufferImageCopy region{.imageSubresource = {image.aspect(), 0, layer, 1},
                                       .imageExtent = {desc.size.x, desc.size.y, 1}};
        device.vk().CmdCopyBufferToImage(commands, staging.handle(), image.handle(),
                                         VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
        if (makeMips)
            blitMips(device, commands, image, layer);
        else
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
