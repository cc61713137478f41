// Running a planned frame: barriers, rendering, dispatches, timing.
#include <time.h>

#include <algorithm>

#include "engine/frame/frame_graph_impl.h"

namespace ag {
namespace {

double processCpuMs() {
    timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return double(t.tv_sec) * 1e3 + double(t.tv_nsec) * 1e-6;
}

void beginLabel(VkCommandBuffer commands, std::string_view name) {
    if (!vkCmdBeginDebugUtilsLabelEXT) return;
    char text[96];
    const size_t length = std::min(name.size(), sizeof text - 1);
    std::copy_n(name.data(), length, text);
    text[length] = 0;
    const VkDebugUtilsLabelEXT label{.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT, .pLabelName = text};
    vkCmdBeginDebugUtilsLabelEXT(commands, &label);
}

void endLabel(VkCommandBuffer commands) {
    if (vkCmdEndDebugUtilsLabelEXT) vkCmdEndDebugUtilsLabelEXT(commands);
}

VkExtent2D extentOf(glm::uvec2 size) {
    return {size.x, size.y};
}

}  // namespace

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
    if (needed && memory.image)
        imageBarriers.push_back({.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2,
                                 .srcStageMask = srcStages,
                                 .srcAccessMask = srcAccess,
                                 .dstStageMask = access.stages,
                                 .dstAccessMask = dstAccess,
                                 .oldLayout = oldLayout,
                                 .newLayout = access.layout,
                                 .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                 .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                 .image = memory.image->handle(),
                                 .subresourceRange = {memory.image->aspect(), 0, VK_REMAINING_MIP_LEVELS, 0,
                                                      VK_REMAINING_ARRAY_LAYERS}});
    if (needed && memory.buffer)
        bufferBarriers.push_back({.sType = VK_STRUCTURE_TYPE_BUFFER_MEMORY_BARRIER_2,
                                  .srcStageMask = srcStages,
                                  .srcAccessMask = srcAccess,
                                  .dstStageMask = access.stages,
                                  .dstAccessMask = dstAccess,
                                  .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                  .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                  .buffer = memory.buffer->handle(),
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
    vkCmdPipelineBarrier2(commands, &info);
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
        if (!r.isOutput || !r.isImage || r.kind == ResourceKind::kImport) continue;
        if (slots[r.slot].halves[r.half].version == 0) continue;
        const Access access{VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_MEMORY_READ_BIT, 0,
                            r.outputLayout};
        addBarrier(r, access, false, nullptr);
    }
    if (commands) flushBarriers(commands);
}

void FrameGraph::Impl::recordCompute(VkCommandBuffer commands, const Pass& pass) {
    const gpu::Pipeline& pipeline = *pass.pipeline;
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.handle);
    if (const VkDescriptorSet set = descriptorSet(pass, pipeline))
        vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.layout, 0, 1, &set, 0,
                                nullptr);
    if (pipeline.pushSizeBytes > 0)
        vkCmdPushConstants(commands, pipeline.layout, pipeline.pushStages, 0, pipeline.pushSizeBytes,
                           pass.push.data());
    if (pass.dispatchIndirect) {
        const auto all = usesOf(pass);
        const auto arguments = std::ranges::find(all, UseKind::kIndirect, &Use::kind);
        vkCmdDispatchIndirect(commands, bufferOf(resources[arguments->resource]).handle(),
                              pass.indirectOffset);
        return;
    }
    const glm::uvec3 size = pass.threads ? pipeline.workgroupSize : glm::uvec3(1);
    const glm::uvec3 groups = (pass.dispatch + size - 1u) / size;
    if (groups.x > 0 && groups.y > 0 && groups.z > 0) vkCmdDispatch(commands, groups.x, groups.y, groups.z);
}

namespace {

VkRenderingAttachmentInfo attachment(const gpu::Image& image, const Use& use) {
    const bool depth = gpu::isDepthFormat(image.desc().format);
    const bool clear = use.kind == UseKind::kColorClear || use.kind == UseKind::kDepthClear;
    VkRenderingAttachmentInfo info{.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
                                   .imageView = image.mipView(0),
                                   .imageLayout = accessOf(use.kind).layout,
                                   .loadOp = clear ? VK_ATTACHMENT_LOAD_OP_CLEAR : VK_ATTACHMENT_LOAD_OP_LOAD,
                                   .storeOp = use.kind == UseKind::kDepthTest ? VK_ATTACHMENT_STORE_OP_NONE
                                                                              : VK_ATTACHMENT_STORE_OP_STORE};
    if (depth)
        info.clearValue.depthStencil = {use.clear.x, 0};
    else
        info.clearValue.color = {{use.clear.x, use.clear.y, use.clear.z, use.clear.w}};
    return info;
}

void setViewport(VkCommandBuffer commands, glm::uvec4 rect) {
    const VkViewport viewport{float(rect.x), float(rect.y), float(rect.z), float(rect.w), 0, 1};
    const VkRect2D scissor{{int32_t(rect.x), int32_t(rect.y)}, {rect.z, rect.w}};
    vkCmdSetViewport(commands, 0, 1, &viewport);
    vkCmdSetScissor(commands, 0, 1, &scissor);
}

void bindGeometry(VkCommandBuffer commands, const Geometry& g) {
    if (!g.positions) return;
    const VkBuffer buffers[] = {g.positions->handle(),
                                g.attributes ? g.attributes->handle() : g.positions->handle()};
    const VkDeviceSize offsets[] = {0, 0};
    vkCmdBindVertexBuffers(commands, 0, 2, buffers, offsets);
    vkCmdBindIndexBuffer(commands, g.indices->handle(), 0, VK_INDEX_TYPE_UINT32);
}

void clearPatch(VkCommandBuffer commands, glm::uvec4 rect, std::span<const Use> uses) {
    const auto atlas = std::ranges::find(uses, UseKind::kDepthPatch, &Use::kind);
    VkClearAttachment clear{.aspectMask = VK_IMAGE_ASPECT_DEPTH_BIT};
    clear.clearValue.depthStencil = {atlas->clear.x, 0};
    const VkClearRect area{{{int32_t(rect.x), int32_t(rect.y)}, {rect.z, rect.w}}, 0, 1};
    vkCmdClearAttachments(commands, 1, &clear, 1, &area);
}

}  // namespace

void FrameGraph::Impl::recordRaster(VkCommandBuffer commands, const Pass& pass) {
    std::array<VkRenderingAttachmentInfo, gpu::kMaxColorTargets> colors{};
    VkRenderingAttachmentInfo depth{};
    uint32_t colorCount = 0;
    bool hasDepth = false;
    glm::uvec2 size(0);
    for (const Use& use : usesOf(pass)) {
        const bool isColor = use.kind == UseKind::kColorClear || use.kind == UseKind::kColorLoad;
        const bool isDepth = use.kind == UseKind::kDepthClear || use.kind == UseKind::kDepthLoad ||
                             use.kind == UseKind::kDepthPatch || use.kind == UseKind::kDepthTest;
        if (!isColor && !isDepth) continue;
        const gpu::Image& image = imageOf(resources[use.resource]);
        size = image.desc().size;
        (isColor ? colors[colorCount++] : depth) = attachment(image, use);
        hasDepth = hasDepth || isDepth;
    }
    const VkRenderingInfo info{.sType = VK_STRUCTURE_TYPE_RENDERING_INFO,
                               .renderArea = {{0, 0}, extentOf(size)},
                               .layerCount = 1,
                               .colorAttachmentCount = colorCount,
                               .pColorAttachments = colors.data(),
                               .pDepthAttachment = hasDepth ? &depth : nullptr};
    vkCmdBeginRendering(commands, &info);
    recordDraws(commands, pass, pass.pipeline ? descriptorSet(pass, *pass.pipeline) : VK_NULL_HANDLE, size);
    vkCmdEndRendering(commands);
}

void FrameGraph::Impl::recordDraws(VkCommandBuffer commands, const Pass& pass, VkDescriptorSet set,
                                   glm::uvec2 size) {
    const glm::uvec4 whole(0, 0, size);
    const auto bind = [&](const gpu::Pipeline& pipeline, std::span<const std::byte> push, glm::uvec4 rect) {
        vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.handle);
        if (set)
            vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.layout, 0, 1, &set, 0,
                                    nullptr);
        if (pipeline.pushSizeBytes > 0) {
            AG_CHECK_EQ(pipeline.pushSizeBytes, push.size());
            vkCmdPushConstants(commands, pipeline.layout, pipeline.pushStages, 0, pipeline.pushSizeBytes,
                               push.data());
        }
        setViewport(commands, rect == glm::uvec4(0) ? whole : rect);
    };
    if (pass.kind == PassKind::kFullscreen) {
        bind(*pass.pipeline, {pass.push.data(), pass.pushSizeBytes}, whole);
        vkCmdDraw(commands, 3, 1, 0, 0);
    }
    bindGeometry(commands, pass.geometry);
    std::vector<Patch>* held = patchesOf(pass);
    const std::span<const RasterDraw> all = drawsOf(pass);
    PassStats& counts = stats[pass.stats];
    counts.patches = counts.patchesDrawn = 0;
    patches.clear();
    for (size_t i = 0; i < all.size(); ++i) {
        const RasterDraw& draw = all[i];
        if (draw.beginsPatch) {
            const auto next = std::find_if(all.begin() + std::ptrdiff_t(i) + 1, all.end(),
                                           [](const RasterDraw& d) { return d.beginsPatch; });
            const size_t end = size_t(next - all.begin());
            const Patch patch{draw.viewport, patchKey(pass, i, end)};
            patches.push_back(patch);
            ++counts.patches;
            const auto known = std::ranges::find(*held, patch.rect, &Patch::rect);
            if (options.skip && known != held->end() && known->key == patch.key) {
                i = end - 1;
                continue;
            }
            ++counts.patchesDrawn;
            clearPatch(commands, patch.rect, usesOf(pass));
            continue;
        }
        bind(pipelines->get(requestFor(pass, &draw)), {draw.push.data(), draw.pushSizeBytes}, draw.viewport);
        vkCmdDrawIndexedIndirect(commands, bufferOf(resources[draw.commands.index]).handle(),
                                 draw.commandsOffsetBytes, draw.commandCount,
                                 sizeof(VkDrawIndexedIndirectCommand));
    }
    // Those not declared now may have been drawn over.
    if (held) std::swap(*held, patches);
}

std::vector<Patch>* FrameGraph::Impl::patchesOf(const Pass& pass) {
    for (const Use& use : usesOf(pass))
        if (use.kind == UseKind::kDepthPatch) return &memoryOf(resources[use.resource])->patches;
    return nullptr;
}

void FrameGraph::Impl::recordTransfer(VkCommandBuffer commands, const Pass& pass) {
    const Use& to = usesOf(pass).back();
    if (pass.kind == PassKind::kFill) {
        vkCmdFillBuffer(commands, bufferOf(resources[to.resource]).handle(), 0, VK_WHOLE_SIZE, pass.fillWord);
    } else if (pass.kind == PassKind::kUpload) {
        constexpr uint32_t kMost = 65536;  // of one command
        for (uint32_t at = 0; at < pass.dataSize; at += kMost)
            vkCmdUpdateBuffer(commands, bufferOf(resources[to.resource]).handle(), at,
                              std::min(kMost, pass.dataSize - at), data.data() + pass.dataOffset + at);
    } else {
        const gpu::Image& source = imageOf(resources[usesOf(pass).front().resource]);
        const gpu::Image& target = imageOf(resources[to.resource]);
        VkImageBlit region{.srcSubresource = {source.aspect(), 0, 0, 1},
                           .dstSubresource = {target.aspect(), 0, 0, 1}};
        region.srcOffsets[1] = {int32_t(source.desc().size.x), int32_t(source.desc().size.y), 1};
        region.dstOffsets[1] = {int32_t(target.desc().size.x), int32_t(target.desc().size.y), 1};
        vkCmdBlitImage(commands, source.handle(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, target.handle(),
                       VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region, VK_FILTER_NEAREST);
    }
}

void FrameGraph::Impl::recordPass(VkCommandBuffer commands, const Pass& pass) {
    beginLabel(commands, pass.name);
    switch (pass.kind) {
        case PassKind::kCompute:
            recordCompute(commands, pass);
            break;
        case PassKind::kFullscreen:
        case PassKind::kRaster:
            recordRaster(commands, pass);
            break;
        default:
            recordTransfer(commands, pass);
            break;
    }
    endLabel(commands);
}

void FrameGraph::Impl::finishPass(const Pass& pass) {
    ++stats[pass.stats].runCount;
    for (const Use& use : usesOf(pass))
        if (writes(use.kind))
            slots[resources[use.resource].slot].halves[resources[use.resource].half].version =
                use.versionAfter;
}

namespace {

// Runs `record` as a submission of its own and returns the process CPU time it took, driver threads included.
template <class F>
double timeOnCpu(gpu::Device& device, VkCommandPool pool, F&& record) {
    const VkCommandBufferAllocateInfo info{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                           .commandPool = pool,
                                           .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
                                           .commandBufferCount = 1};
    VkCommandBuffer commands = VK_NULL_HANDLE;
    AG_VK(vkAllocateCommandBuffers(device.handle(), &info, &commands));
    const VkCommandBufferBeginInfo begin{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                                         .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT};
    AG_VK(vkBeginCommandBuffer(commands, &begin));
    record(commands);
    AG_VK(vkEndCommandBuffer(commands));
    const double before = processCpuMs();
    device.waitFor(device.submit(commands));
    const double spent = processCpuMs() - before;
    vkFreeCommandBuffers(device.handle(), pool, 1, &commands);
    return spent;
}

}  // namespace

void FrameGraph::execute(VkCommandBuffer commands) {
    Impl& g = *impl_;
    g.plan();
    const bool timed = g.device && g.options.timing == TimingMode::kTimestamps && commands;
    const bool alone = g.device && g.options.timing == TimingMode::kProcessCpu;
    if (g.device) {
        g.device->collect();
        g.createResources();
        if (alone)
            timeOnCpu(*g.device, g.ownPool, [&](VkCommandBuffer own) { g.zeroNewHistories(own); });
        else
            g.zeroNewHistories(commands);
    }
    if (timed) g.timer->beginFrame(commands, [&](uint32_t tag, double ms) { g.stats[tag].gpuMs = ms; });
    g.report.clear();
    g.records.clear();
    for (const Pass& pass : g.passes) {
        PassStats& stats = g.stats[pass.stats];
        const PassOutcome outcome = pass.runs     ? PassOutcome::kRan
                                    : pass.wanted ? PassOutcome::kSkipped
                                                  : PassOutcome::kDropped;
        if (pass.runs) {
            PassRecord* record = g.device ? nullptr : &g.records.emplace_back(PassRecord{pass.name, {}});
            if (alone) {
                stats.cpuMs = timeOnCpu(*g.device, g.ownPool, [&](VkCommandBuffer own) {
                    g.synchronize(own, pass, record);
                    g.recordPass(own, pass);
                });
            } else {
                g.synchronize(commands, pass, record);
                if (timed) g.timer->begin(commands, pass.stats);
                if (g.device) g.recordPass(commands, pass);
                if (timed) g.timer->end(commands);
            }
            g.finishPass(pass);
        } else {
            stats.gpuMs = stats.cpuMs = 0;
        }
        g.report.push_back({pass.name, outcome, stats.gpuMs, stats.cpuMs, stats.runCount, stats.patches,
                            stats.patchesDrawn});
    }
    g.commitHistories();
    if (alone)
        timeOnCpu(*g.device, g.ownPool, [&](VkCommandBuffer own) { g.synchronizeOutputs(own); });
    else
        g.synchronizeOutputs(commands);
    g.retireUnused();
}

}  // namespace ag
