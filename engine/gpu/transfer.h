// Blocking copies between host and device, for loading, readback and tests: stages, submits, waits.
#pragma once

#include "engine/gpu/device.h"
#include "engine/gpu/resources.h"

namespace ag::gpu {

constexpr VkFormat kVec4Texels = VK_FORMAT_R32G32B32A32_SFLOAT;  // of buffers that are read as rows of vec4

void uploadBuffer(Device& device, Buffer& buffer, std::span<const std::byte> bytes, uint64_t offset = 0);
void downloadBuffer(Device& device, const Buffer& buffer, std::span<std::byte> bytes, uint64_t offset = 0);
// A buffer of just these items (room for one if there are none); `desc` without its size.
template <class T>
std::unique_ptr<Buffer> loadBuffer(Device& device, BufferDesc desc, const std::vector<T>& items) {
    desc.sizeBytes = std::max<uint64_t>(items.size(), 1) * sizeof(T);
    auto buffer = std::make_unique<Buffer>(device, desc);
    if (!items.empty()) uploadBuffer(device, *buffer, std::as_bytes(std::span(items)));
    return buffer;
}
// Texels of all mips of one layer, the finest first, tightly packed. Leaves the image in
// SHADER_READ_ONLY_OPTIMAL.
void uploadImage(Device& device, Image& image, uint32_t layer, std::span<const std::byte> texels);
// `layout`: the layout the image is in, and is left in.
void downloadImage(Device& device, const Image& image, VkImageLayout layout, std::span<std::byte> texels);

}  // namespace ag::gpu
