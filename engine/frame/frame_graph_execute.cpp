// Running a planned frame: barriers and timing.
#include <algorithm>

#include "engine/frame/frame_graph_impl.h"

namespace ag {
// A dependency on what was done to the resource before, if this access needs one.
void FrameGraph::Impl::addBarrier(Resource& r, const Access& access, bool discard, PassRecord* record) {
    if (r.kind == ResourceKind::kImport)
        return;  // read-only, in its layout: made visible by whoever wrote it
    Memory& memory = slots[r.slot].halves[r.half];
    SyncState& s = memory.sync;
    VkPipelineStageFlags2 srcStages = s.writeStages;
    VkAccessFlags2 srcAccess = s.writeAccess;
    AliasBucket* bucket = slots[r.slot].bucket == ~0u ? nullptr : &buckets[slots[r.slot].bucket];
    if (bucket && std::exchange(bucket->lastUser, r.slot) != r.slot) {
        // Another image was here: wait for all of its work, take the memory without its contents.
        s.layout = VK_IMAGE_LAYOUT_UNDEFINED;
        srcStages = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
        srcAccess = VK_ACCESS_2_MEMORY_WRITE_BIT;
        s.readStages = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    }
    const bool write = access.writes != 0;
    const bool relayout = r.isImage && s.layout != access.layout;
    const bool seen = (s.visibleStages & access.stages) == access.stages &&
                      (s.visibleAccess & access.reads) == access.reads;
    const bool afterWrite = s.writeStages != 0 && !seen;
    const bool afterRead = s.readStages != 0 && (write || relayout);
    if (write || relayout) srcStages |= s.readStages;
    const VkImageLayout oldLayout = discard ? VK_IMAGE_LAYOUT_UNDEFINED : s.layout;
    const VkAccessFlags2 dstAccess = access.reads | access.writes;
    const bool needed = relayout || afterRead || (write ? s.writeStages != 0 : afterWrite);
    if (needed && record)
        record->barriers.push_back({r.name, srcStages, access.stages, srcAccess, dstAccess,
                                    r.isImage ? oldLayout : VK_IMAGE_LAYOUT_UNDEFINED,
                                    r.isImage ? access.layout : VK_IMAGE_LAYOUT_UNDEFINED});
    const gpu::Image* const image = imageIn(memory);
    const gpu::Buffer* const buffer = bufferIn(memory);
    if (needed && image)
        imageBarriers.push_back({.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2,
                                 .srcStageMask = srcStages,
                                 .srcAccessMask = srcAccess,
                                 .dstStageMask = access.stages,
                                 .dstAccessMask = dstAccess,
                                 .oldLayout = oldLayout,
                                 .newLayout = access.layout,
                                 .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                 .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                 .image = image->handle(),
                                 .subresourceRange = {image->aspect(), 0, VK_REMAINING_MIP_LEVELS, 0,
                                                      VK_REMAINING_ARRAY_LAYERS}});
    if (needed && buffer)
        bufferBarriers.push_back({.sType = VK_STRUCTURE_TYPE_BUFFER_MEMORY_BARRIER_2,
                                  .srcStageMask = srcStages,
                                  .srcAccessMask = srcAccess,
                                  .dstStageMask = access.stages,
                                  .dstAccessMask = dstAccess,
                                  .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                  .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                  .buffer = buffer->handle(),
                                  .size = VK_WHOLE_SIZE});
    if (write || relayout) {
        // A layout change counts as a write that ended before these stages.
        s = {.writeStages = access.stages, .writeAccess = access.writes, .layout = access.layout};
        if (!write) {
            s.visibleStages = access.stages;
            s.visibleAccess = access.reads;
            s.readStages = access.stages;
        }
        if (!r.isImage) s.layout = VK_IMAGE_LAYOUT_UNDEFINED;
        return;
    }
    s.readStages |= access.stages;
    if (!afterWrite) return;
    s.visibleStages |= access.stages;
    s.visibleAccess |= access.reads;
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
    const uint64_t read = timer->beginFrame(commands, frame, [&](uint32_t tag, uint64_t begin, uint64_t end) {
        if (count++ == 0) spans.clear();
        stats[tag].gpuMs = timer->milliseconds(end - begin);
        spans.push_back({stats[tag].name, begin, end});
    });
    if (read) spansFrame = read;
}

// For passes whose results do not depend on what they wrote before.
void FrameGraph::Impl::repeatPass(VkCommandBuffer commands, const Pass& pass) {
    const VkMemoryBarrier2 all{.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2,
                               .srcStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                               .srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT,
                               .dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                               .dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT};
    const VkDependencyInfo info{
        .sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO, .memoryBarrierCount = 1, .pMemoryBarriers = &all};
    for (uint32_t i = 1; i < options.repeats; ++i) {
        context->vk().CmdPipelineBarrier2(commands, &info);
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
    for (const Pass& pass : passes) {
        const PassReport before = reportOf(pass);
        if (pass.runs) {
            run(pass);
            finishPass(pass);
        }
        report.push_back(finishReport(pass, before));
    }
    commitHistories();
}

void FrameGraph::execute(VkCommandBuffer commands) {
    Impl& g = *impl_;
    AG_CHECK(g.options.timing != TimingMode::kProcessCpu);
    g.plan();
    const bool timed = g.context && g.options.timing == TimingMode::kTimestamps && commands;
    const bool counted =
        g.context && g.context->info().counts && g.options.timing == TimingMode::kCounts && commands;
    if (timed && !g.timer) g.timer = std::make_unique<FrameTimer>(*g.context);
    if (counted && !g.counter) g.counter = std::make_unique<PassCounter>(*g.context);
    if (g.context) {
        g.createResources();
        g.zeroNewHistories(commands);
    }
    if (timed) g.readTimes(commands);
    if (counted) g.counter->beginFrame(commands);
    g.runPasses([&](const Pass& pass) {
        PassRecord* record = g.context ? nullptr : &g.records.emplace_back(PassRecord{pass.name, {}});
        g.synchronize(commands, pass, record);
        if (timed) g.timer->begin(commands, pass.stats);
        if (counted) g.counter->begin(commands, pass.name);
        if (g.context) g.recordPass(commands, pass);
        if (g.context && pass.name == g.options.repeatPass) g.repeatPass(commands, pass);
        if (counted) g.counter->end(commands);
        if (timed) g.timer->end(commands);
    });
    if (timed) g.timer->endFrame(commands);
    g.synchronizeOutputs(commands);
    g.retireUnused();
}

void FrameGraph::preparePipelines() {
    impl_->resolvePipelines();
}

void FrameGraph::executeAlone(Submit submit) {
    Impl& g = *impl_;
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
