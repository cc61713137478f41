#include "engine/gpu/memory.h"

#include <algorithm>

#include "engine/core/check.h"
#include "engine/gpu/context.h"

namespace ag::gpu {
namespace {

constexpr uint64_t kBlockBytes = uint64_t(64) << 20;

uint64_t alignUp(uint64_t value, uint64_t alignment) {
    return (value + alignment - 1) / alignment * alignment;
}

}  // namespace

MemoryAllocator::MemoryAllocator(Context& context, MemorySource source)
    : context_(context), source_(std::move(source)) {
    context_.vk().GetPhysicalDeviceMemoryProperties(context_.physical(), &properties_);
}

MemoryAllocator::~MemoryAllocator() {
    for (Block& block : blocks_)
        if (block.place.memory) release(block.place);
}

VkResult MemoryAllocator::allocateBlock(uint64_t sizeBytes, uint32_t type, bool hostVisible,
                                        MemoryBlock& block) {
    if (source_.allocate) return source_.allocate(sizeBytes, type, hostVisible, block);
    const VkMemoryAllocateInfo info{.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
                                    .allocationSize = sizeBytes,
                                    .memoryTypeIndex = type};
    const Functions& vk = context_.vk();
    const VkDevice device = context_.handle();
    VkResult result = vk.AllocateMemory(device, &info, context_.hostAllocation(), &block.memory);
    void* mapped = nullptr;
    if (result == VK_SUCCESS && hostVisible)
        result = vk.MapMemory(device, block.memory, 0, VK_WHOLE_SIZE, 0, &mapped);
    block.mapped = static_cast<std::byte*>(mapped);
    if (result != VK_SUCCESS) vk.FreeMemory(device, block.memory, context_.hostAllocation());
    return result;
}

void MemoryAllocator::release(const MemoryBlock& block) {
    if (source_.release) return source_.release(block);
    context_.vk().FreeMemory(context_.handle(), block.memory, context_.hostAllocation());
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
        std::byte* const mapped = block.place.mapped;
        range = {block.place.memory, offset, requirements.size,
                 mapped ? mapped + (offset - block.place.offset) : nullptr,
                 uint32_t(&block - blocks_.data())};
        return true;
    }
    return false;
}

uint32_t MemoryAllocator::addBlock(uint64_t sizeBytes, uint32_t type, bool hostVisible, MemoryUse use) {
    Block block{.sizeBytes = sizeBytes, .type = type, .use = use};
    checkVk(allocateBlock(sizeBytes, type, hostVisible, block.place), "vkAllocateMemory");
    block.gaps = {{block.place.offset, sizeBytes}};
    if (!source_.allocate)
        context_.setDebugName(VK_OBJECT_TYPE_DEVICE_MEMORY, block.place.memory,
                              hostVisible                 ? "memory.host"
                              : use == MemoryUse::kBuffer ? "memory.buffers"
                                                          : "memory.images");
    for (uint32_t i = 0; i < blocks_.size(); ++i) {
        if (blocks_[i].place.memory) continue;
        blocks_[i] = std::move(block);
        return i;
    }
    blocks_.push_back(std::move(block));
    return uint32_t(blocks_.size() - 1);
}

MemoryRange MemoryAllocator::allocate(const VkMemoryRequirements& requirements, bool hostVisible,
                                      MemoryUse use) {
    const std::lock_guard lock(mutex_);
    if (context_.strikes(Fault::kAllocation)) checkVk(VK_ERROR_OUT_OF_DEVICE_MEMORY, "vkAllocateMemory");
    const uint32_t type = findType(requirements.memoryTypeBits, hostVisible);
    MemoryRange range;
    bool taken = false;
    for (Block& block : blocks_) {
        const bool fits = block.place.memory && block.type == type && block.use == use &&
                          bool(block.place.mapped) == hostVisible;
        if (taken = fits && takeFrom(block, requirements, range); taken) break;
    }
    if (!taken) {
        const uint64_t aside = source_.allocate ? requirements.alignment : 0;  // a host's offset may be any
        const uint32_t added =
            addBlock(std::max(kBlockBytes, requirements.size + aside), type, hostVisible, use);
        AG_CHECK(takeFrom(blocks_[added], requirements, range));
    }
    liveBytes_ += requirements.size;
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
    release(block.place);  // wholly free: give it back
    block = {};
}

uint64_t MemoryAllocator::liveBytes() const {
    const std::lock_guard lock(mutex_);
    return liveBytes_;
}

uint64_t MemoryAllocator::blockBytes() const {
    const std::lock_guard lock(mutex_);
    uint64_t bytes = 0;
    for (const Block& block : blocks_)
        bytes += block.place.memory ? block.sizeBytes : 0;
    return bytes;
}

uint64_t MemoryAllocator::blockCount() const {
    const std::lock_guard lock(mutex_);
    return uint64_t(
        std::ranges::count_if(blocks_, [](const Block& b) { return b.place.memory != VK_NULL_HANDLE; }));
}

}  // namespace ag::gpu
