// Buffers and images with their memory. Plain owners: destroying one frees it at once, so the caller makes
// sure the device no longer uses it (FrameGraph retires its own through Context::retire).
#pragma once

#include "engine/gpu/functions.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include "engine/gpu/memory.h"

namespace ag::gpu {

class Context;

struct BufferDesc {
    std::string name;
    uint64_t sizeBytes = 0;
    bool hostVisible = false;                    // mapped for the CPU: staging, readback, per-frame uploads
    bool indirect = false;                       // may feed draw or dispatch indirect
    bool vertexOrIndex = false;                  // may be bound as vertex or index buffer
    VkFormat texelFormat = VK_FORMAT_UNDEFINED;  // with a format: also readable as a texel buffer
};

// Every buffer can be a storage buffer and a transfer source and destination.
class Buffer {
  public:
    Buffer(Context& context, const BufferDesc& desc);
    // A host's, that outlives this.
    Buffer(Context& context, const BufferDesc& desc, VkBuffer borrowed);
    ~Buffer();
    Buffer(const Buffer&) = delete;
    Buffer& operator=(const Buffer&) = delete;

    VkBuffer handle() const { return handle_; }
    uint64_t id() const { return id_; }  // never used again in this process, unlike the handle
    const BufferDesc& desc() const { return desc_; }
    uint64_t sizeBytes() const { return desc_.sizeBytes; }
    std::byte* mapped() const { return mapped_; }  // null unless hostVisible
    // Texel view over the whole buffer in desc.texelFormat; null without a format, and where the device's
    // texel buffers are too small (DeviceInfo::storageTexels).
    VkBufferView texelView() const { return texelView_; }
    bool isBorrowed() const { return borrowed_; }

  private:
    void create();
    void createTexelView();
    void destroy();

    Context& context_;
    BufferDesc desc_;
    uint64_t id_;
    VkBuffer handle_ = VK_NULL_HANDLE;
    VkBufferView texelView_ = VK_NULL_HANDLE;
    MemoryRange memory_;
    std::byte* mapped_ = nullptr;
    bool borrowed_ = false;
};

struct ImageDesc {
    std::string name;
    VkFormat format = VK_FORMAT_UNDEFINED;
    glm::uvec2 size{0};
    uint32_t layers = 1;
    uint32_t mips = 1;
    bool array = false;  // view type 2D array even with one layer
    // Of the frame graph: between queue families it changes its owner by barriers. Others are shared.
    bool owned = false;
};

bool isDepthFormat(VkFormat format);
// A bare image without memory, and what memory it would need: for placing several in one range.
VkImage makeImage(Context& context, const ImageDesc& desc);
VkMemoryRequirements imageRequirements(Context& context, const ImageDesc& desc);

// Usage flags are everything the format allows among sampled, storage, attachment and transfer.
class Image {
  public:
    // `memory`: where to place it; null takes memory of its own. Aliased images share one range.
    Image(Context& context, const ImageDesc& desc, const MemoryRange* memory = nullptr);
    // A host's image with a view of its one mip; both outlive this.
    Image(Context& context, const ImageDesc& desc, VkImage borrowed, VkImageView view);
    ~Image();
    Image(const Image&) = delete;
    Image& operator=(const Image&) = delete;

    VkImage handle() const { return handle_; }
    uint64_t id() const { return id_; }
    VkImageView view() const { return view_; }  // all mips and layers
    VkImageView mipView(uint32_t mip) const;    // one mip, all layers; made at construction
    const ImageDesc& desc() const { return desc_; }
    VkImageAspectFlags aspect() const;
    bool isBorrowed() const { return borrowed_; }

  private:
    void create(const MemoryRange* memory);
    void destroy();

    Context& context_;
    ImageDesc desc_;
    uint64_t id_;
    bool borrowed_ = false;
    VkImage handle_ = VK_NULL_HANDLE;
    VkImageView view_ = VK_NULL_HANDLE;
    std::unique_ptr<VkImageView[]> mipViews_;
    MemoryRange memory_;  // empty where the memory is the caller's
};

// Gone when the work that may still use it has finished; may be null.
void retire(Context& context, std::unique_ptr<Buffer> buffer);
uint32_t texelSizeBytes(VkFormat format);

}  // namespace ag::gpu
