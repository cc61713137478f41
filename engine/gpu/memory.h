// Device memory in large blocks, cut by a first-fit free list. Buffers and images never share a block, so
// bufferImageGranularity does not matter.
#pragma once

#include "engine/gpu/functions.h"

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <vector>

#include "engine/gpu/device_faults.h"

namespace ag::gpu {

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

class MemoryAllocator {
  public:
    // `faults` may make an allocation fail.
    MemoryAllocator(const Functions& vk, VkPhysicalDevice physical, VkDevice device, FaultCounter& faults);
    ~MemoryAllocator();
    MemoryAllocator(const MemoryAllocator&) = delete;
    MemoryAllocator& operator=(const MemoryAllocator&) = delete;

    // Ends the program when the device is out of memory.
    MemoryRange allocate(const VkMemoryRequirements& requirements, bool hostVisible, MemoryUse use);
    void free(const MemoryRange& range);
    uint64_t liveBytes() const;
    uint64_t blockCount() const;

  private:
    struct Gap {
        uint64_t offset, sizeBytes;
    };
    struct Block {
        VkDeviceMemory memory = VK_NULL_HANDLE;
        uint64_t sizeBytes = 0;
        uint32_t type = 0;
        MemoryUse use = MemoryUse::kBuffer;
        std::byte* mapped = nullptr;
        std::vector<Gap> gaps;  // ascending, never touching
    };
    uint32_t findType(uint32_t allowed, bool hostVisible) const;
    bool takeFrom(Block& block, const VkMemoryRequirements& requirements, MemoryRange& range);
    uint32_t addBlock(uint64_t sizeBytes, uint32_t type, bool hostVisible, MemoryUse use);

    const Functions& vk_;
    VkDevice device_;
    FaultCounter& faults_;
    VkPhysicalDeviceMemoryProperties properties_{};
    std::vector<Block> blocks_;
    uint64_t liveBytes_ = 0;
    mutable std::mutex mutex_;
};

}  // namespace ag::gpu
