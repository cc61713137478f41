// A frame on two queues: which command buffer a pass goes to, what waits for what, whose an image is.
//
// Passes of a queue go to its open batch. One that needs what the other queue does begins a batch of its own
// that waits for the other's batch, which takes no more passes then. The first batch of the second queue
// waits for the first of the main one and so for all frames before; the last of the main one waits for all.
#include <algorithm>

#include "engine/frame/frame_graph_impl.h"

namespace ag {

using gpu::Queue;

// What is used on the second queue shares no memory with others: their uses overlap in time.
void FrameGraph::Impl::markAsync() {
    if (!batches.begin) return;
    for (const Pass& pass : passes)
        if (pass.async)
            for (const Use& use : usesOf(pass))
                resources[use.resource].async = true;
}

void FrameGraph::Impl::beginBatches(VkCommandBuffer commands, const BeginBatch* begin) {
    batches.begin = begin;
    batches.all.assign(1, {Queue::kMain, commands, Batches::kNone});
    batches.open = {0, Batches::kNone};
    batches.waited = {Batches::kNone, Batches::kNone};
    batches.queue = Queue::kMain;
    batches.ownerChanges.clear();
}

VkCommandBuffer FrameGraph::Impl::beginBatch(Queue queue, int32_t after) {
    const size_t own = size_t(queue), other = size_t(gpu::otherQueue(queue));
    if (after != Batches::kNone) {
        batches.waited[own] = after;
        if (batches.open[other] == after) batches.open[other] = Batches::kNone;
    }
    batches.open[own] = int32_t(batches.all.size());
    return batches.all.emplace_back(QueueBatch{queue, (*batches.begin)(queue), after}).commands;
}

// The last batch of the other queue that the pass needs the end of.
int32_t FrameGraph::Impl::neededBatch(const Pass& pass, Queue queue) {
    const size_t own = size_t(queue), other = size_t(gpu::otherQueue(queue));
    int32_t needed = queue == Queue::kAsync ? 0 : Batches::kNone;
    for (const Use& use : usesOf(pass)) {
        Resource& r = resources[use.resource];
        if (r.kind == ResourceKind::kImport) continue;
        const Memory& memory = *memoryOf(r);
        if (memory.usedFrame != frame) continue;
        const bool moves = r.isImage && (memory.sync[own].layout != accessOf(use.kind).layout ||
                                         (twoFamilies() && memory.owner != queue));
        const bool change = writes(use.kind) || moves;
        needed = std::max(needed, change ? memory.lastUse[other] : memory.lastChange[other]);
    }
    return needed;
}

VkCommandBuffer FrameGraph::Impl::commandsFor(const Pass& pass) {
    if (!batches.begin) return batches.all[0].commands;
    batches.queue = pass.async ? Queue::kAsync : Queue::kMain;
    const size_t own = size_t(batches.queue);
    const int32_t needed = neededBatch(pass, batches.queue);
    if (needed > batches.waited[own]) return beginBatch(batches.queue, needed);
    if (batches.open[own] == Batches::kNone) return beginBatch(batches.queue, Batches::kNone);
    return batches.all[size_t(batches.open[own])].commands;
}

void FrameGraph::Impl::noteUse(Memory& memory, bool change) {
    if (memory.usedFrame != frame) memory.lastUse = memory.lastChange = {Batches::kNone, Batches::kNone};
    memory.usedFrame = frame;
    const size_t own = size_t(batches.queue);
    memory.lastUse[own] = batches.open[own];
    if (change) memory.lastChange[own] = batches.open[own];
}

// Without a device queues are of two families, so that tests see what changes its owner.
bool FrameGraph::Impl::twoFamilies() const {
    return context ? context->twoFamilies() : batches.begin != nullptr;
}

// The same layouts on both sides (Vulkan 1.3, 7.7.4). What is written anew needs no owner of before.
void FrameGraph::Impl::takeOwner(const Resource& r, Memory& memory, const Access& access, bool discard) {
    const Queue to = batches.queue, from = memory.owner;
    if (!r.isImage || from == to || !twoFamilies()) return;
    memory.owner = to;
    const SyncState before = memory.sync[size_t(from)];
    if (discard || before.layout == VK_IMAGE_LAYOUT_UNDEFINED) {
        memory.sync[size_t(to)] = stateForOther(VK_IMAGE_LAYOUT_UNDEFINED);
        return;
    }
    const int32_t released = batches.waited[size_t(to)];
    AG_CHECK_MSG(released >= 0, std::string(r.name) + " has no batch to be released in");
    batches.ownerChanges.push_back({r.name, released, batches.open[size_t(to)]});
    // All that came before is over once the semaphore is.
    memory.sync[size_t(from)] = stateForOther(access.layout);
    memory.sync[size_t(to)] = {
        .visibleStages = access.stages, .visibleAccess = access.reads, .layout = access.layout};
    if (!context) return;
    const gpu::Image& image = *imageIn(memory);
    const uint32_t families[] = {context->queueFamily(), *context->asyncFamily()};
    VkImageMemoryBarrier2 barrier{
        .sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2,
        .srcStageMask = before.writeStages | before.readStages,
        .srcAccessMask = before.writeAccess,
        .oldLayout = before.layout,
        .newLayout = access.layout,
        .srcQueueFamilyIndex = families[size_t(from)],
        .dstQueueFamilyIndex = families[size_t(to)],
        .image = image.handle(),
        .subresourceRange = {image.aspect(), 0, VK_REMAINING_MIP_LEVELS, 0, VK_REMAINING_ARRAY_LAYERS}};
    const VkDependencyInfo release{.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO,
                                   .imageMemoryBarrierCount = 1,
                                   .pImageMemoryBarriers = &barrier};
    context->vk().CmdPipelineBarrier2(batches.all[size_t(released)].commands, &release);
    barrier.srcStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;  // after the semaphore
    barrier.srcAccessMask = 0;
    barrier.dstStageMask = access.stages;
    barrier.dstAccessMask = access.reads | access.writes;
    imageBarriers.push_back(barrier);
}

// The frame ends on the main queue, and every image is its own again.
VkCommandBuffer FrameGraph::Impl::joinQueues() {
    const auto lastAsync =
        std::ranges::find(batches.all.rbegin(), batches.all.rend(), Queue::kAsync, &QueueBatch::queue);
    batches.queue = Queue::kMain;
    if (lastAsync != batches.all.rend()) {
        const int32_t last = int32_t(batches.all.rend() - lastAsync) - 1;
        if (batches.waited[0] < last)
            beginBatch(Queue::kMain, last);
        else if (batches.open[0] == Batches::kNone)
            beginBatch(Queue::kMain, Batches::kNone);
    }
    const VkCommandBuffer commands = batches.all[size_t(batches.open[0])].commands;
    for (Slot& slot : slots)
        for (Memory& half : slot.halves) {
            if (half.owner == Queue::kMain || !twoFamilies()) continue;
            const VkImageLayout layout = half.sync[size_t(Queue::kAsync)].layout;
            takeOwner({.name = slot.name, .isImage = true}, half,
                      {VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_MEMORY_READ_BIT, 0, layout}, false);
            half.sync[size_t(Queue::kMain)].readStages = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
        }
    if (commands) flushBarriers(commands);
    return commands;
}

}  // namespace ag
