// Recording passes: dispatches, draws, atlases of patches, transfers.
#include <algorithm>
#include <optional>

#include "engine/frame/frame_graph_impl.h"

namespace ag {
namespace {

void beginLabel(const gpu::Functions& vk, VkCommandBuffer commands, std::string_view name) {
    if (!vk.CmdBeginDebugUtilsLabelEXT) return;
    char text[96];
    const size_t length = std::min(name.size(), sizeof text - 1);
    std::copy_n(name.data(), length, text);
    text[length] = 0;
    const VkDebugUtilsLabelEXT label{.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT, .pLabelName = text};
    vk.CmdBeginDebugUtilsLabelEXT(commands, &label);
}

void endLabel(const gpu::Functions& vk, VkCommandBuffer commands) {
    if (vk.CmdEndDebugUtilsLabelEXT) vk.CmdEndDebugUtilsLabelEXT(commands);
}

VkExtent2D extentOf(glm::uvec2 size) {
    return {size.x, size.y};
}

}  // namespace

void FrameGraph::Impl::recordCompute(VkCommandBuffer commands, const Pass& pass) {
    const gpu::Pipeline& pipeline = *pass.pipeline;
    context->vk().CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.handle);
    if (const VkDescriptorSet set = descriptorSet(pass, pipeline))
        context->vk().CmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.layout, 0, 1,
                                            &set, 0, nullptr);
    if (pipeline.pushSizeBytes > 0)
        context->vk().CmdPushConstants(commands, pipeline.layout, pipeline.pushStages, 0,
                                       pipeline.pushSizeBytes, pass.push.data());
    if (pass.partCount > 0) return recordParts(commands, pass);
    if (pass.dispatchIndirect) {
        const auto all = usesOf(pass);
        const auto arguments = std::ranges::find(all, UseKind::kIndirect, &Use::kind);
        context->vk().CmdDispatchIndirect(commands, bufferOf(resources[arguments->resource]).handle(),
                                          pass.indirectOffset);
        return;
    }
    const glm::uvec3 size = pass.threads ? pipeline.workgroupSize : glm::uvec3(1);
    const glm::uvec3 groups = (pass.dispatch + size - 1u) / size;
    const uint32_t* most = context->info().limits.maxComputeWorkGroupCount;
    for (int axis = 0; axis < 3; ++axis)
        if (groups[axis] > most[axis])
            gpu::failBeyondLimit("the pass " + std::string(pass.name), "maxComputeWorkGroupCount",
                                 groups[axis], most[axis]);
    if (groups.x > 0 && groups.y > 0 && groups.z > 0)
        context->vk().CmdDispatch(commands, groups.x, groups.y, groups.z);
}

// Parts side by side that both changed are one dispatch.
void FrameGraph::Impl::recordParts(VkCommandBuffer commands, const Pass& pass) {
    constexpr uint32_t kMostGroups = 65535;  // of a dispatch, on any device
    const auto written = std::ranges::find_if(usesOf(pass), [](const Use& use) { return writes(use.kind); });
    std::vector<GroupPart>& held = memoryOf(resources[written->resource])->parts;
    const std::span<const GroupPart> all = partsOf(pass);
    PassStats& counts = stats[pass.stats];
    counts.patches = pass.partCount;
    counts.patchesDrawn = 0;
    const auto dispatch = [&](uint32_t first, uint32_t end) {
        for (; first < end; first += kMostGroups) {
            context->vk().CmdPushConstants(commands, pass.pipeline->layout, pass.pipeline->pushStages, 0,
                                           sizeof first, &first);
            context->vk().CmdDispatch(commands, std::min(end - first, kMostGroups), 1, 1);
        }
    };
    uint32_t first = 0, end = 0;
    for (size_t i = 0; i < all.size(); ++i) {
        if (options.skip && i < held.size() && held[i] == all[i]) continue;
        ++counts.patchesDrawn;
        if (all[i].firstGroup != end) {
            dispatch(first, end);
            first = all[i].firstGroup;
        }
        end = all[i].firstGroup + all[i].groupCount;
    }
    dispatch(first, end);
    held.assign(all.begin(), all.end());
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

void setViewport(const gpu::Functions& vk, VkCommandBuffer commands, glm::uvec4 rect) {
    const VkViewport viewport{float(rect.x), float(rect.y), float(rect.z), float(rect.w), 0, 1};
    const VkRect2D scissor{{int32_t(rect.x), int32_t(rect.y)}, {rect.z, rect.w}};
    vk.CmdSetViewport(commands, 0, 1, &viewport);
    vk.CmdSetScissor(commands, 0, 1, &scissor);
}

void bindVertices(const gpu::Functions& vk, VkCommandBuffer commands, const gpu::Buffer& positions,
                  const gpu::Buffer* attributes) {
    const VkBuffer buffers[] = {positions.handle(), attributes ? attributes->handle() : positions.handle()};
    const VkDeviceSize offsets[] = {0, 0};
    vk.CmdBindVertexBuffers(commands, 0, 2, buffers, offsets);
}

void bindGeometry(const gpu::Functions& vk, VkCommandBuffer commands, const Geometry& g) {
    if (!g.positions) return;
    bindVertices(vk, commands, *g.positions, g.attributes);
    vk.CmdBindIndexBuffer(commands, g.indices->handle(), 0, VK_INDEX_TYPE_UINT32);
}

void clearPatch(const gpu::Functions& vk, VkCommandBuffer commands, glm::uvec4 rect,
                std::span<const Use> uses) {
    const auto atlas = std::ranges::find(uses, UseKind::kDepthPatch, &Use::kind);
    VkClearAttachment clear{.aspectMask = VK_IMAGE_ASPECT_DEPTH_BIT};
    clear.clearValue.depthStencil = {atlas->clear.x, 0};
    const VkClearRect area{{{int32_t(rect.x), int32_t(rect.y)}, {rect.z, rect.w}}, 0, 1};
    vk.CmdClearAttachments(commands, 1, &clear, 1, &area);
}

// Of the draws of the patch that begins at `first`.
size_t endOfPatch(std::span<const RasterDraw> all, size_t first) {
    const auto next = std::find_if(all.begin() + std::ptrdiff_t(first) + 1, all.end(),
                                   [](const RasterDraw& d) { return d.beginsPatch; });
    return size_t(next - all.begin());
}

void bindRaster(const gpu::Functions& vk, VkCommandBuffer commands, const gpu::Pipeline& pipeline,
                VkDescriptorSet set, std::span<const std::byte> push) {
    vk.CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.handle);
    if (set)
        vk.CmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.layout, 0, 1, &set, 0,
                                 nullptr);
    if (pipeline.pushSizeBytes == 0) return;
    AG_CHECK_EQ(pipeline.pushSizeBytes, push.size());
    vk.CmdPushConstants(commands, pipeline.layout, pipeline.pushStages, 0, pipeline.pushSizeBytes,
                        push.data());
}

// Ends also where recording runs out of memory: the command buffer is a guest's, who ends it.
class Rendering {
  public:
    Rendering(const gpu::Functions& vk, VkCommandBuffer commands, const VkRenderingInfo& info)
        : vk_(vk), commands_(commands) {
        vk_.CmdBeginRendering(commands_, &info);
    }
    ~Rendering() { vk_.CmdEndRendering(commands_); }
    Rendering(const Rendering&) = delete;
    Rendering& operator=(const Rendering&) = delete;

  private:
    const gpu::Functions& vk_;
    VkCommandBuffer commands_;
};

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
    const VkDescriptorSet set = pass.pipeline ? descriptorSet(pass, *pass.pipeline) : VK_NULL_HANDLE;
    const bool attached = colorCount > 0 || hasDepth;
    std::optional<Rendering> rendering;
    if (attached) rendering.emplace(context->vk(), commands, info);
    if (pass.callback != ~0u)
        recordCallback(commands, pass, set, size);
    else
        recordDraws(commands, pass, set, size);
}

void FrameGraph::Impl::recordCallback(VkCommandBuffer commands, const Pass& pass, VkDescriptorSet set,
                                      glm::uvec2 size) {
    const gpu::Functions& vk = context->vk();
    if (pass.pipeline) {
        vk.CmdBindPipeline(commands, pass.pipeline->bindPoint, pass.pipeline->handle);
        if (set)
            vk.CmdBindDescriptorSets(commands, pass.pipeline->bindPoint, pass.pipeline->layout, 0, 1, &set, 0,
                                     nullptr);
    }
    if (size != glm::uvec2(0)) setViewport(vk, commands, {0, 0, size});
    callbacks[pass.callback]({commands, pass.pipeline, size});
}

// Notes what the patch is to hold and clears it; false: it holds that already.
bool FrameGraph::Impl::beginPatch(VkCommandBuffer commands, const Pass& pass, const Patch& patch) {
    PassStats& counts = stats[pass.stats];
    patches.push_back(patch);
    ++counts.patches;
    const std::vector<Patch>& held = *patchesOf(pass);
    const auto known = std::ranges::find(held, patch.rect, &Patch::rect);
    if (options.skip && known != held.end() && known->key == patch.key) return false;
    ++counts.patchesDrawn;
    clearPatch(context->vk(), commands, patch.rect, usesOf(pass));
    return true;
}

void FrameGraph::Impl::recordDraws(VkCommandBuffer commands, const Pass& pass, VkDescriptorSet set,
                                   glm::uvec2 size) {
    const glm::uvec4 whole(0, 0, size);
    if (pass.kind == PassKind::kFullscreen) {
        bindRaster(context->vk(), commands, *pass.pipeline, set, {pass.push.data(), pass.pushSizeBytes});
        setViewport(context->vk(), commands, whole);
        context->vk().CmdDraw(commands, 3, 1, 0, 0);
    }
    bindGeometry(context->vk(), commands, pass.geometry);
    bool deformed = false;  // the vertices bound
    const auto bindVerticesOf = [&](const RasterDraw& draw) {
        const Geometry& g = pass.geometry;
        if (std::exchange(deformed, draw.deformed) == draw.deformed) return;
        if (deformed)
            bindVertices(context->vk(), commands, bufferOf(resources[g.deformedPositions.index]),
                         &bufferOf(resources[g.deformedAttributes.index]));
        else
            bindVertices(context->vk(), commands, *g.positions, g.attributes);
    };
    const std::span<const RasterDraw> all = drawsOf(pass);
    stats[pass.stats].patches = stats[pass.stats].patchesDrawn = 0;
    patches.clear();
    for (size_t i = 0; i < all.size(); ++i) {
        const RasterDraw& draw = all[i];
        if (draw.beginsPatch) {
            const size_t end = endOfPatch(all, i);
            if (!beginPatch(commands, pass, {draw.viewport, patchKey(pass, i, end)})) i = end - 1;
            continue;
        }
        bindVerticesOf(draw);
        bindRaster(context->vk(), commands, pipelines->get(requestFor(pass, &draw)), set,
                   {draw.push.data(), draw.pushSizeBytes});
        setViewport(context->vk(), commands, draw.viewport == glm::uvec4(0) ? whole : draw.viewport);
        context->vk().CmdDrawIndexedIndirect(commands, bufferOf(resources[draw.commands.index]).handle(),
                                             draw.commandsOffsetBytes, draw.commandCount,
                                             sizeof(VkDrawIndexedIndirectCommand));
    }
    // Those not declared now may have been drawn over.
    if (std::vector<Patch>* held = patchesOf(pass)) std::swap(*held, patches);
}

std::vector<Patch>* FrameGraph::Impl::patchesOf(const Pass& pass) {
    for (const Use& use : usesOf(pass))
        if (use.kind == UseKind::kDepthPatch) return &memoryOf(resources[use.resource])->patches;
    return nullptr;
}

namespace {

void copyWhole(const gpu::Functions& vk, VkCommandBuffer commands, const gpu::Image& source,
               const gpu::Image& target) {
    const VkImageCopy region{.srcSubresource = {source.aspect(), 0, 0, 1},
                             .dstSubresource = {target.aspect(), 0, 0, 1},
                             .extent = {source.desc().size.x, source.desc().size.y, 1}};
    vk.CmdCopyImage(commands, source.handle(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, target.handle(),
                    VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
}

}  // namespace

void FrameGraph::Impl::recordTransfer(VkCommandBuffer commands, const Pass& pass) {
    const Use& to = usesOf(pass).back();
    if (pass.kind == PassKind::kFill) {
        context->vk().CmdFillBuffer(commands, bufferOf(resources[to.resource]).handle(), 0, VK_WHOLE_SIZE,
                                    pass.fillWord);
    } else if (pass.kind == PassKind::kUpload) {
        constexpr uint32_t kMost = 65536;  // of one command
        for (uint32_t at = 0; at < pass.dataSize; at += kMost)
            context->vk().CmdUpdateBuffer(commands, bufferOf(resources[to.resource]).handle(), at,
                                          std::min(kMost, pass.dataSize - at),
                                          data.data() + pass.dataOffset + at);
    } else if (pass.kind == PassKind::kCopyBuffer) {
        const gpu::Buffer& source = bufferOf(resources[usesOf(pass).front().resource]);
        const VkBufferCopy region{.size = resources[to.resource].buffer.sizeBytes};
        context->vk().CmdCopyBuffer(commands, source.handle(), bufferOf(resources[to.resource]).handle(), 1,
                                    &region);
    } else {
        const gpu::Image& source = imageOf(resources[usesOf(pass).front().resource]);
        const gpu::Image& target = imageOf(resources[to.resource]);
        if (source.desc().size == target.desc().size && source.desc().format == target.desc().format)
            return copyWhole(context->vk(), commands, source, target);
        VkImageBlit region{.srcSubresource = {source.aspect(), 0, 0, 1},
                           .dstSubresource = {target.aspect(), 0, 0, 1}};
        region.srcOffsets[1] = {int32_t(source.desc().size.x), int32_t(source.desc().size.y), 1};
        region.dstOffsets[1] = {int32_t(target.desc().size.x), int32_t(target.desc().size.y), 1};
        context->vk().CmdBlitImage(commands, source.handle(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                                   target.handle(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region,
                                   VK_FILTER_NEAREST);
    }
}

void FrameGraph::Impl::recordPass(VkCommandBuffer commands, const Pass& pass) {
    beginLabel(context->vk(), commands, pass.name);
    switch (pass.kind) {
        case PassKind::kCompute:
            recordCompute(commands, pass);
            break;
        case PassKind::kFullscreen:
        case PassKind::kRaster:
        case PassKind::kCallback:
            recordRaster(commands, pass);
            break;
        default:
            recordTransfer(commands, pass);
            break;
    }
    endLabel(context->vk(), commands);
}

}  // namespace ag
