// Device memory in large blocks, cut by a first-fit free list. Buffers and images never share a block, so
// bufferImageGranularity does not matter. Blocks come from Vulkan or from a host.
#pragma once

#include "engine/gpu/functions.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <vector>

namespace ag::gpu {

class Context;

// A piece of a memory block. Value type; given back by whoever took it.
struct MemoryRange {
    VkDeviceMemory memory = VK_NULL_HANDLE;
    uint64_t offset = 0;
    uint64_t sizeBytes = 0;
    std::byte* mapped = nullptr;  // host pointer to the range, if it is host-visible
    uint32_t block = ~0u;

    explicit operator bool() const { return memory != VK_NULL_HANDLE; }
};

enum class MemoryUse : uint32_t { kBuffer, kImage };

// What a block lies in: a piece of an allocation, mapped if it is host-visible.
struct MemoryBlock {
    VkDeviceMemory memory = VK_NULL_HANDLE;
    uint64_t offset = 0;
    std::byte* mapped = nullptr;
};

// A host's own allocation of device memory. Both empty: blocks come from vkAllocateMemory.
struct MemorySource {
    // Of memory type `type`; VK_SUCCESS or why not.
    std::function<VkResult(uint64_t sizeBytes, uint32_t type, bool hostVisible, MemoryBlock& block)> allocate;
    std::function<void(const MemoryBlock& block)> release;
};

class MemoryAllocator {
  public:
    MemoryAllocator(Context& context, MemorySource source);
    ~MemoryAllocator();
    MemoryAllocator(const MemoryAllocator&) = delete;
    MemoryAllocator& operator=(const MemoryAllocator&) = delete;

    // Fails (failure.h) when the device is out of memory.
    MemoryRange allocate(const VkMemoryRequirements& requirements, bool hostVisible, MemoryUse use);
    void free(const MemoryRange& range);
    uint64_t liveBytes() const;
    uint64_t blockCount() const;
    uint64_t blockBytes() const;

  private:
    struct Gap {
        uint64_t offset, sizeBytes;
    };
    struct Block {
        MemoryBlock place;
        uint64_t sizeBytes = 0;
        uint32_t type = 0;
        MemoryUse use = MemoryUse::kBuffer;
        std::vector<Gap> gaps;  // of the allocation: ascending, never touching
    };
    uint32_t findType(uint32_t allowed, bool hostVisible) const;
    bool takeFrom(Block& block, const VkMemoryRequirements& requirements, MemoryRange& range);
    uint32_t addBlock(uint64_t sizeBytes, uint32_t type, bool hostVisible, MemoryUse use);
    VkResult allocateBlock(uint64_t sizeBytes, uint32_t type, bool hostVisible, MemoryBlock& block);
    void release(const MemoryBlock& block);

    Context& context_;
    MemorySource source_;
    VkPhysicalDeviceMemoryProperties properties_{};
    std::vector<Block> blocks_;
    uint64_t liveBytes_ = 0;
    mutable std::mutex mutex_;
};

}  // namespace ag::gpu
