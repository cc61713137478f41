// Running a planned frame: barriers and timing.
#include <algorithm>
#include <optional>

#include "engine/frame/frame_graph_impl.h"
#include "engine/gpu/barrier.h"

namespace ag {
namespace {

// Whether the access waits for reads, too.
bool changes(const Resource& r, const SyncState& s, const Access& access) {
    return access.writes != 0 || (r.isImage && s.layout != access.layout);
}

// Whether there is a write that the access would not see.
bool misses(const SyncState& s, const Access& access) {
    const bool seen = (s.visibleStages & access.stages) == access.stages &&
                      (s.visibleAccess & access.reads) == access.reads;
    return s.writeStages != 0 && !seen;
}

// What the access waits for; none: it may begin at once.
std::optional<BarrierRecord> barrierBefore(const Resource& r, const SyncState& s, const Access& access,
                                           bool discard) {
    const bool write = access.writes != 0, change = changes(r, s, access);
    const bool relayout = r.isImage && s.layout != access.layout;
    const bool afterRead = s.readStages != 0 && change;
    const bool afterWrite = write ? s.writeStages != 0 : misses(s, access);
    if (!relayout && !afterRead && !afterWrite) return std::nullopt;
    return BarrierRecord{.resource = r.name,
                         .srcStages = s.writeStages | (change ? s.readStages : 0),
                         .dstStages = access.stages,
                         .srcAccess = s.writeAccess,
                         .dstAccess = access.reads | access.writes,
                         .oldLayout = r.isImage && !discard ? s.layout : VK_IMAGE_LAYOUT_UNDEFINED,
                         .newLayout = r.isImage ? access.layout : VK_IMAGE_LAYOUT_UNDEFINED};
}

SyncState stateAfter(const Resource& r, const SyncState& s, const Access& access) {
    SyncState after = s;
    if (changes(r, s, access)) {
        // A layout change counts as a write that ended before these stages.
        after = {.writeStages = access.stages,
                 .writeAccess = access.writes,
                 .layout = r.isImage ? access.layout : VK_IMAGE_LAYOUT_UNDEFINED};
        if (access.writes != 0) return after;
        after.visibleStages = access.stages;
        after.visibleAccess = access.reads;
        after.readStages = access.stages;
        return after;
    }
    after.readStages |= access.stages;
    if (!misses(s, access)) return after;
    after.visibleStages |= access.stages;
    after.visibleAccess |= access.reads;
    return after;
}

VkImageMemoryBarrier2 imageBarrier(const BarrierRecord& b, const gpu::Image& image) {
    return {.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2,
            .srcStageMask = b.srcStages,
            .srcAccessMask = b.srcAccess,
            .dstStageMask = b.dstStages,
            .dstAccessMask = b.dstAccess,
            .oldLayout = b.oldLayout,
            .newLayout = b.newLayout,
            .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
            .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
            .image = image.handle(),
            .subresourceRange = {image.aspect(), 0, VK_REMAINING_MIP_LEVELS, 0, VK_REMAINING_ARRAY_LAYERS}};
}

VkBufferMemoryBarrier2 bufferBarrier(const BarrierRecord& b, const gpu::Buffer& buffer) {
    return {.sType = VK_STRUCTURE_TYPE_BUFFER_MEMORY_BARRIER_2,
            .srcStageMask = b.srcStages,
            .srcAccessMask = b.srcAccess,
            .dstStageMask = b.dstStages,
            .dstAccessMask = b.dstAccess,
            .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
            .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
            .buffer = buffer.handle(),
            .size = VK_WHOLE_SIZE};
}

}  // namespace

// A dependency on what was done to the resource before, if this access needs one.
void FrameGraph::Impl::addBarrier(Resource& r, const Access& access, bool discard, PassRecord* record) {
    if (r.kind == ResourceKind::kImport)
        return;  // read-only, in its layout: made visible by whoever wrote it
    Memory& memory = slots[r.slot].halves[r.half];
    AliasBucket* bucket = slots[r.slot].bucket == ~0u ? nullptr : &buckets[slots[r.slot].bucket];
    if (bucket && std::exchange(bucket->lastUser, r.slot) != r.slot) memory.sync.fill(kTakenOver);
    takeOwner(r, memory, access, discard);
    const gpu::Queue queue = batches.queue;
    SyncState& sync = memory.sync[size_t(queue)];
    const std::optional<BarrierRecord> barrier = barrierBefore(r, sync, access, discard);
    const bool change = changes(r, sync, access);
    sync = stateAfter(r, sync, access);
    if (change) memory.sync[size_t(otherQueue(queue))] = stateForOther(sync.layout);
    noteUse(memory, change);
    if (!barrier) return;
    if (record) record->barriers.push_back(*barrier);
    if (const gpu::Image* image = imageIn(memory)) imageBarriers.push_back(imageBarrier(*barrier, *image));
    if (const gpu::Buffer* buffer = bufferIn(memory))
        bufferBarriers.push_back(bufferBarrier(*barrier, *buffer));
}

void FrameGraph::Impl::flushBarriers(VkCommandBuffer commands) {
    if (imageBarriers.empty() && bufferBarriers.empty()) return;
    const VkDependencyInfo info{.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO,
                                .bufferMemoryBarrierCount = uint32_t(bufferBarriers.size()),
                                .pBufferMemoryBarriers = bufferBarriers.data(),
                                .imageMemoryBarrierCount = uint32_t(imageBarriers.size()),
                                .pImageMemoryBarriers = imageBarriers.data()};
    context->vk().CmdPipelineBarrier2(commands, &info);
    imageBarriers.clear();
    bufferBarriers.clear();
}

// One barrier command before the pass. Several uses of one resource in a pass become one access.
void FrameGraph::Impl::synchronize(VkCommandBuffer commands, const Pass& pass, PassRecord* record) {
    const auto all = usesOf(pass);
    for (size_t i = 0; i < all.size(); ++i) {
        const uint32_t resource = all[i].resource;
        const auto earlier = all.first(i);
        if (std::ranges::find(earlier, resource, &Use::resource) != earlier.end()) continue;
        Access merged = accessOf(all[i].kind);
        bool discard = !readsOld(all[i].kind);
        for (size_t j = i + 1; j < all.size(); ++j) {
            if (all[j].resource != resource) continue;
            const Access& other = accessOf(all[j].kind);
            merged.stages |= other.stages;
            merged.reads |= other.reads;
            merged.writes |= other.writes;
            discard = discard && !readsOld(all[j].kind);
            if (merged.layout == VK_IMAGE_LAYOUT_UNDEFINED) merged.layout = other.layout;
            AG_CHECK_MSG(!resources[resource].isImage || merged.layout == other.layout,
                         std::string(pass.name) + " uses " + std::string(resources[resource].name) +
                             " in two layouts at once");
        }
        addBarrier(resources[resource], merged, discard, record);
    }
    if (commands) flushBarriers(commands);
}

void FrameGraph::Impl::synchronizeOutputs(VkCommandBuffer commands) {
    for (Resource& r : resources) {
        if (!r.isOutput || r.kind == ResourceKind::kImport) continue;
        const Memory& memory = slots[r.slot].halves[r.half];
        if (memory.version == 0 && !memory.borrowedImage) continue;
        if (r.isImage)
            addBarrier(r,
                       {VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_MEMORY_READ_BIT, 0, r.outputLayout},
                       false, nullptr);
        else if (r.buffer.hostVisible)
            addBarrier(
                r, {VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT, 0, VK_IMAGE_LAYOUT_UNDEFINED},
                false, nullptr);
    }
    if (commands) flushBarriers(commands);
}

void FrameGraph::Impl::finishPass(const Pass& pass) {
    PassStats& known = stats[pass.stats];
    ++known.runCount;
    known.ownKey = ownKey(pass);
    known.inputVersions.clear();
    for (const Use& use : usesOf(pass))
        known.inputVersions.push_back(use.versionBefore);
    for (const Use& use : usesOf(pass))
        if (writes(use.kind)) {
            Memory& memory = *memoryOf(resources[use.resource]);
            memory.version = use.versionAfter;
            memory.stepVersion = use.stepVersionAfter;
        }
}

void FrameGraph::Impl::readTimes(VkCommandBuffer commands) {
    size_t count = 0;
    const bool bracketed = options.timing == TimingMode::kBracketed;
    const uint64_t read =
        timer->beginFrame(commands, frame, bracketed, [&](uint32_t tag, uint64_t begin, uint64_t end) {
            if (count++ == 0) spans.clear();
            stats[tag].gpuMs = timer->milliseconds(end - begin);
            spans.push_back({*stats[tag].fullName, begin, end});
        });
    if (read) spansFrame = read;
}

// For passes whose results do not depend on what they wrote before.
void FrameGraph::Impl::repeatPass(VkCommandBuffer commands, const Pass& pass) {
    for (uint32_t i = 1; i < options.repeats; ++i) {
        gpu::fullBarrier(context->vk(), commands);
        recordPass(commands, pass);
    }
}

PassReport FrameGraph::Impl::finishReport(const Pass& pass, PassReport made) {
    PassStats& known = stats[pass.stats];
    if (!pass.runs) known.gpuMs = known.cpuMs = 0;
    made.gpuMs = known.gpuMs;
    made.cpuMs = known.cpuMs;
    made.runCount = known.runCount;
    made.patches = known.patches;
    made.patchesDrawn = known.patchesDrawn;
    return made;
}

// `run` does the work of a pass and what must happen before it.
template <class Run>
void FrameGraph::Impl::runPasses(Run&& run) {
    report.clear();
    records.clear();
    ++framesRun;
    for (const Pass& pass : passes) {
        if (pass.wanted) stats[pass.stats].wantedIn = framesRun;
        const PassReport before = reportOf(pass);
        if (pass.runs) {
            run(pass);
            finishPass(pass);
        }
        report.push_back(finishReport(pass, before));
    }
    commitHistories();
}

void FrameGraph::Impl::run(VkCommandBuffer commands) {
    const bool stamps = options.timing == TimingMode::kTimestamps || options.timing == TimingMode::kBracketed;
    const bool timed = context && stamps && commands;
    const bool counted =
        context && context->info().counts && options.timing == TimingMode::kCounts && commands;
    if (timed && !timer) timer = std::make_unique<FrameTimer>(*context);
    if (counted && !counter) counter = std::make_unique<PassCounter>(*context);
    if (context) {
        createResources();
        zeroNewHistories(commands);
    }
    if (timed) readTimes(commands);
    if (counted) counter->beginFrame(commands);
    runPasses([&](const Pass& pass) {
        const VkCommandBuffer to = commandsFor(pass);
        PassRecord* record =
            context ? nullptr
                    : &records.emplace_back(PassRecord{pass.name, {}, batches.open[size_t(batches.queue)]});
        synchronize(to, pass, record);
        if (timed) timer->begin(to, pass.stats);
        if (counted) counter->begin(to, pass.name);
        if (context) recordPass(to, pass);
        if (context && pass.name == options.repeatPass) repeatPass(to, pass);
        if (counted) counter->end(to);
        if (timed) timer->end(to);
    });
    const VkCommandBuffer last = joinQueues();
    if (timed) timer->endFrame(last);
    synchronizeOutputs(last);
    retireUnused();
}

void FrameGraph::execute(VkCommandBuffer commands) {
    Impl& g = *impl_;
    AG_CHECK(g.options.timing != TimingMode::kProcessCpu);
    g.beginBatches(commands, nullptr);
    g.plan();
    g.run(commands);
}

std::span<const QueueBatch> FrameGraph::execute(VkCommandBuffer commands, BeginBatch begin) {
    Impl& g = *impl_;
    const bool mayOverlap =
        g.options.timing == TimingMode::kTimestamps || g.options.timing == TimingMode::kOff;
    const bool second = !g.context || g.context->asyncFamily();
    g.beginBatches(commands, g.options.async && mayOverlap && second ? &begin : nullptr);
    g.plan();
    g.run(commands);
    return g.batches.all;
}

void FrameGraph::preparePipelines() {
    impl_->resolvePipelines();
}

void FrameGraph::executeAlone(Submit submit) {
    Impl& g = *impl_;
    g.beginBatches(VK_NULL_HANDLE, nullptr);
    g.plan();
    g.createResources();
    submit([&](VkCommandBuffer own) { g.zeroNewHistories(own); });
    g.runPasses([&](const Pass& pass) {
        g.stats[pass.stats].cpuMs = submit([&](VkCommandBuffer own) {
            g.synchronize(own, pass, nullptr);
            g.recordPass(own, pass);
        });
    });
    submit([&](VkCommandBuffer own) { g.synchronizeOutputs(own); });
    g.retireUnused();
}

}  // namespace ag
