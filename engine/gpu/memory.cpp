#include "engine/gpu/memory.h"

#include <algorithm>

#include "engine/core/check.h"
#include "engine/gpu/debug_name.h"
#include "engine/gpu/device.h"

namespace ag::gpu {
namespace {

constexpr uint64_t kBlockBytes = uint64_t(64) << 20;

uint64_t alignUp(uint64_t value, uint64_t alignment) {
    return (value + alignment - 1) / alignment * alignment;
}

}  // namespace

MemoryAllocator::MemoryAllocator(const Functions& vk, VkPhysicalDevice physical, VkDevice device,
                                 FaultCounter& faults)
    : vk_(vk), device_(device), faults_(faults) {
    vk_.GetPhysicalDeviceMemoryProperties(physical, &properties_);
}

MemoryAllocator::~MemoryAllocator() {
    for (Block& block : blocks_)
        if (block.memory) vk_.FreeMemory(device_, block.memory, nullptr);
}

uint32_t MemoryAllocator::findType(uint32_t allowed, bool hostVisible) const {
    constexpr VkMemoryPropertyFlags kHost =
        VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    const VkMemoryPropertyFlags required = hostVisible ? kHost : 0;
    const VkMemoryPropertyFlags liked = hostVisible
                                            ? VkMemoryPropertyFlags(VK_MEMORY_PROPERTY_HOST_CACHED_BIT)
                                            : VkMemoryPropertyFlags(VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    for (const VkMemoryPropertyFlags wanted : {liked | required, required})
        for (uint32_t i = 0; i < properties_.memoryTypeCount; ++i)
            if ((allowed >> i & 1) && (properties_.memoryTypes[i].propertyFlags & wanted) == wanted) return i;
    AG_CHECK_MSG(false, "no memory type fits a resource");
    return 0;
}

bool MemoryAllocator::takeFrom(Block& block, const VkMemoryRequirements& requirements, MemoryRange& range) {
    for (size_t i = 0; i < block.gaps.size(); ++i) {
        const Gap gap = block.gaps[i];
        const uint64_t offset = alignUp(gap.offset, requirements.alignment);
        const uint64_t end = offset + requirements.size;
        if (end > gap.offset + gap.sizeBytes) continue;
        block.gaps.erase(block.gaps.begin() + i);
        if (end < gap.offset + gap.sizeBytes)
            block.gaps.insert(block.gaps.begin() + i, {end, gap.offset + gap.sizeBytes - end});
        if (offset > gap.offset) block.gaps.insert(block.gaps.begin() + i, {gap.offset, offset - gap.offset});
        range = {block.memory, offset, requirements.size, block.mapped ? block.mapped + offset : nullptr,
                 uint32_t(&block - blocks_.data())};
        return true;
    }
    return false;
}

uint32_t MemoryAllocator::addBlock(uint64_t sizeBytes, uint32_t type, bool hostVisible, MemoryUse use) {
    Block block{.sizeBytes = sizeBytes, .type = type, .use = use, .gaps = {{0, sizeBytes}}};
    const VkMemoryAllocateInfo info{.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
                                    .allocationSize = sizeBytes,
                                    .memoryTypeIndex = type};
    AG_VK(vk_.AllocateMemory(device_, &info, nullptr, &block.memory));
    setDebugName(vk_, device_, VK_OBJECT_TYPE_DEVICE_MEMORY, block.memory,
                 hostVisible                 ? "memory.host"
                 : use == MemoryUse::kBuffer ? "memory.buffers"
                                             : "memory.images");
    if (hostVisible) {
        void* mapped = nullptr;
        AG_VK(vk_.MapMemory(device_, block.memory, 0, VK_WHOLE_SIZE, 0, &mapped));
        block.mapped = static_cast<std::byte*>(mapped);
    }
    for (uint32_t i = 0; i < blocks_.size(); ++i) {
        if (blocks_[i].memory) continue;
        blocks_[i] = std::move(block);
        return i;
    }
    blocks_.push_back(std::move(block));
    return uint32_t(blocks_.size() - 1);
}

MemoryRange MemoryAllocator::allocate(const VkMemoryRequirements& requirements, bool hostVisible,
                                      MemoryUse use) {
    const std::lock_guard lock(mutex_);
    if (faults_.strikes(Fault::kAllocation)) checkVk(VK_ERROR_OUT_OF_DEVICE_MEMORY, "vkAllocateMemory");
    const uint32_t type = findType(requirements.memoryTypeBits, hostVisible);
    MemoryRange range;
    liveBytes_ += requirements.size;
    for (Block& block : blocks_) {
        const bool fits =
            block.memory && block.type == type && block.use == use && bool(block.mapped) == hostVisible;
        if (fits && takeFrom(block, requirements, range)) return range;
    }
    const uint32_t added = addBlock(std::max(kBlockBytes, requirements.size), type, hostVisible, use);
    AG_CHECK(takeFrom(blocks_[added], requirements, range));
    return range;
}

void MemoryAllocator::free(const MemoryRange& range) {
    const std::lock_guard lock(mutex_);
    Block& block = blocks_[range.block];
    auto next = std::ranges::find_if(block.gaps, [&](const Gap& g) { return g.offset > range.offset; });
    auto gap = block.gaps.insert(next, {range.offset, range.sizeBytes});
    if (gap + 1 != block.gaps.end() && gap->offset + gap->sizeBytes == (gap + 1)->offset) {
        gap->sizeBytes += (gap + 1)->sizeBytes;
        block.gaps.erase(gap + 1);
    }
    if (gap != block.gaps.begin() && (gap - 1)->offset + (gap - 1)->sizeBytes == gap->offset) {
        (gap - 1)->sizeBytes += gap->sizeBytes;
        block.gaps.erase(gap);
    }
    liveBytes_ -= range.sizeBytes;
    if (block.gaps.size() != 1 || block.gaps[0].sizeBytes != block.sizeBytes) return;
    vk_.FreeMemory(device_, block.memory, nullptr);  // wholly free: give it back
    block = {};
}

uint64_t MemoryAllocator::liveBytes() const {
    const std::lock_guard lock(mutex_);
    return liveBytes_;
}

uint64_t MemoryAllocator::blockCount() const {
    const std::lock_guard lock(mutex_);
    return uint64_t(
        std::ranges::count_if(blocks_, [](const Block& b) { return b.memory != VK_NULL_HANDLE; }));
}

}  // namespace ag::gpu
