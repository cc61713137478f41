#include "engine/frame/frame_timer.h"

#include <utility>

#include "engine/gpu/barrier.h"
#include "engine/gpu/context.h"
#include "engine/gpu/resources.h"

namespace ag {
namespace {

constexpr uint32_t kTimestamps = 2 * FrameTimer::kMaxPasses;

}  // namespace

FrameTimer::FrameTimer(gpu::Context& context)
    : context_(context), periodNs_(context.info().timestampPeriodNs) {
    for (Ring& ring : rings_) {
        ring.ticks = std::make_unique<gpu::Buffer>(
            context, gpu::BufferDesc{.name = "frame_timer.ticks",
                                     .sizeBytes = kTimestamps * sizeof(uint64_t),
                                     .hostVisible = true});
        ring.passes.reserve(kMaxPasses);
    }
    for (Ring& ring : rings_) {
        const VkQueryPoolCreateInfo info{.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO,
                                         .queryType = VK_QUERY_TYPE_TIMESTAMP,
                                         .queryCount = kTimestamps};
        AG_VK(context.vk().CreateQueryPool(context.handle(), &info, context.hostAllocation(), &ring.pool));
        context.vk().ResetQueryPool(context.handle(), ring.pool, 0, kTimestamps);
        context.setDebugName(VK_OBJECT_TYPE_QUERY_POOL, ring.pool, "frame_timer");
    }
}

FrameTimer::~FrameTimer() {
    for (Ring& ring : rings_)
        context_.vk().DestroyQueryPool(context_.handle(), ring.pool, context_.hostAllocation());
}

std::span<const uint64_t> FrameTimer::ticksOf(const Ring& ring) {
    const auto* ticks = reinterpret_cast<const uint64_t*>(ring.ticks->mapped());
    return {ticks, ring.ticksUsed};
}

void FrameTimer::restart(VkCommandBuffer commands, Ring& ring) {
    context_.vk().CmdResetQueryPool(commands, ring.pool, 0, kTimestamps);
    ring.passes.clear();
    ring.ticksUsed = 0;
    last_ = VK_NULL_HANDLE;
    active_ = next_;
    next_ = (next_ + 1) % rings_.size();
}

uint32_t FrameTimer::stamp(VkCommandBuffer commands) {
    Ring& ring = rings_[active_];
    if (bracketed_) gpu::fullBarrier(context_.vk(), commands);
    context_.vk().CmdWriteTimestamp2(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, ring.pool,
                                     ring.ticksUsed);
    if (bracketed_) gpu::fullBarrier(context_.vk(), commands);
    return ring.ticksUsed++;
}

void FrameTimer::begin(VkCommandBuffer commands, uint32_t tag) {
    Ring& ring = rings_[active_];
    open_ = periodNs_ != 0 && ring.passes.size() < kMaxPasses;
    if (!open_) return;
    const uint32_t first =
        std::exchange(last_, commands) == commands ? ring.passes.back().end : stamp(commands);
    ring.passes.push_back({.tag = tag, .begin = first});
}

void FrameTimer::end(VkCommandBuffer commands) {
    if (!std::exchange(open_, false)) return;
    rings_[active_].passes.back().end = stamp(commands);
}

void FrameTimer::endFrame(VkCommandBuffer commands) {
    const Ring& ring = rings_[active_];
    if (ring.passes.empty()) return;
    context_.vk().CmdCopyQueryPoolResults(commands, ring.pool, 0, ring.ticksUsed, ring.ticks->handle(), 0,
                                          sizeof(uint64_t),
                                          VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT);
    const VkMemoryBarrier2 toHost{
        .sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2,
        .srcStageMask = VK_PIPELINE_STAGE_2_COPY_BIT,
        .srcAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT,
        // Read by the host, and written again when the ring comes round.
        .dstStageMask = VK_PIPELINE_STAGE_2_HOST_BIT | VK_PIPELINE_STAGE_2_COPY_BIT,
        .dstAccessMask = VK_ACCESS_2_HOST_READ_BIT | VK_ACCESS_2_TRANSFER_WRITE_BIT};
    const VkDependencyInfo info{
        .sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO, .memoryBarrierCount = 1, .pMemoryBarriers = &toHost};
    context_.vk().CmdPipelineBarrier2(commands, &info);
}

}  // namespace ag
