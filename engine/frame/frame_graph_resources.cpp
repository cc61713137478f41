// Device objects behind the declared resources: memory, samplers.
#include <algorithm>
#include <array>

#include "engine/frame/frame_graph_impl.h"
#include "engine/gpu/retire.h"

namespace ag {
namespace {

constexpr uint64_t kFramesKept = 16;  // a resource not declared for so long is given back

gpu::ImageDesc descOf(const Slot& slot) {
    return {.name = slot.name,
            .format = slot.image.format,
            .size = slot.image.size,
            .mips = slot.image.mips,
            .owned = true};
}

gpu::BufferDesc descOf(const Slot& slot, const BufferInfo& info) {
    return {.name = slot.name,
            .sizeBytes = std::max<uint64_t>(info.sizeBytes, 16),
            .hostVisible = info.hostVisible,
            .indirect = info.indirect,
            .vertexOrIndex = info.vertices,
            .texelFormat = info.texelFormat};
}

constexpr float kMostAnisotropy = 16;  // texels along a pixel's longer side

VkSampler makeSampler(gpu::Context& context, Sampler kind) {
    const bool repeat = kind >= Sampler::kLinearRepeat, mips = kind >= Sampler::kTrilinearRepeat;
    const VkFilter filter = kind == Sampler::kNearestClamp ? VK_FILTER_NEAREST : VK_FILTER_LINEAR;
    const VkSamplerAddressMode mode =
        repeat ? VK_SAMPLER_ADDRESS_MODE_REPEAT : VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    const float anisotropy =
        kind == Sampler::kAnisotropicRepeat ? std::min(kMostAnisotropy, context.info().mostAnisotropy) : 1;
    const VkSamplerCreateInfo info{
        .sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO,
        .magFilter = filter,
        .minFilter = filter,
        .mipmapMode = mips ? VK_SAMPLER_MIPMAP_MODE_LINEAR : VK_SAMPLER_MIPMAP_MODE_NEAREST,
        .addressModeU = mode,
        .addressModeV = mode,
        .addressModeW = mode,
        .anisotropyEnable = anisotropy > 1,
        .maxAnisotropy = anisotropy,
        .maxLod = mips ? VK_LOD_CLAMP_NONE : 0.25f};
    VkSampler sampler = VK_NULL_HANDLE;
    AG_VK(context.vk().CreateSampler(context.handle(), &info, context.hostAllocation(), &sampler));
    constexpr const char* kNames[kSamplers] = {"sampler.nearest_clamp", "sampler.linear_clamp",
                                               "sampler.linear_repeat", "sampler.trilinear_repeat",
                                               "sampler.anisotropic_repeat"};
    context.setDebugName(VK_OBJECT_TYPE_SAMPLER, sampler, kNames[size_t(kind)]);
    return sampler;
}

}  // namespace

void FrameGraph::Impl::retireMemory(Slot& slot) {
    for (Memory& half : slot.halves) {
        if (context) {
            gpu::retireOwned(*context, std::move(half.image));
            gpu::retireOwned(*context, std::move(half.buffer));
        }
        half = {};
    }
    slot.current = 0;
    slot.stepKey = 0;
    slot.fresh = true;
}

void FrameGraph::Impl::retireUnused() {
    for (Slot& slot : slots) {
        if (slot.fresh || slot.lastFrame + kFramesKept > frame) continue;
        bucketsStale = bucketsStale || slot.bucket != ~0u;
        retireMemory(slot);
    }
}

// Scratch images into buckets: first fit by the span of passes that use them, in declaration order, so that
// the placement is the same every frame however much of it is skipped.
void FrameGraph::Impl::placeScratch() {
    const auto scratch = [&](const Resource& r) {
        return r.kind == ResourceKind::kOwned && r.isImage && r.image.lifetime == Lifetime::kScratch &&
               r.firstPass != ~0u && !slots[r.slot].isHistory;
    };
    bool overlap = false;  // uses moved so that sharers would meet
    for (AliasBucket& bucket : buckets)
        bucket.busyUntil = 0;
    for (Resource& r : resources) {
        if (!scratch(r)) continue;
        const uint32_t b = slots[r.slot].bucket;
        if (b == ~0u || slots[r.slot].async != r.async) {
            bucketsStale = true;
            continue;
        }
        overlap = overlap || r.firstPass + 1 <= buckets[b].busyUntil;
        buckets[b].busyUntil = std::max(buckets[b].busyUntil, r.async ? ~0u : r.lastPass + 1);
    }
    if (!bucketsStale && !overlap && placedAliased == options.alias) return;
    bucketsStale = false;
    placedAliased = options.alias;

    for (AliasBucket& bucket : buckets) {
        for (uint32_t slot : bucket.slots) {
            retireMemory(slots[slot]);
            slots[slot].bucket = ~0u;
        }
        if (bucket.range) context->retire([d = context, range = bucket.range] { d->memory().free(range); });
    }
    buckets.clear();
    for (Resource& r : resources) {
        if (!scratch(r)) continue;
        Slot& slot = slots[r.slot];
        retireMemory(slot);
        slot.async = r.async;
        const bool alone = !options.alias || r.async;
        uint32_t found = 0;
        while (found < buckets.size() && (alone || r.firstPass + 1 <= buckets[found].busyUntil))
            ++found;
        if (found == buckets.size()) buckets.emplace_back();
        AliasBucket& bucket = buckets[found];
        bucket.busyUntil = r.async ? ~0u : r.lastPass + 1;
        bucket.slots.push_back(r.slot);
        slot.bucket = found;
        if (!context) continue;
        const VkMemoryRequirements need = gpu::imageRequirements(*context, descOf(slot));
        const bool first = bucket.slots.size() == 1;
        bucket.requirements.size = std::max(bucket.requirements.size, need.size);
        bucket.requirements.alignment = std::max(bucket.requirements.alignment, need.alignment);
        bucket.requirements.memoryTypeBits =
            first ? need.memoryTypeBits : bucket.requirements.memoryTypeBits & need.memoryTypeBits;
        AG_CHECK(bucket.requirements.memoryTypeBits != 0);
    }
    if (!context) return;
    for (AliasBucket& bucket : buckets)
        bucket.range = context->memory().allocate(bucket.requirements, false, gpu::MemoryUse::kImage);
}

void FrameGraph::Impl::createResources() {
    if (!samplers[0])
        for (size_t i = 0; i < samplers.size(); ++i)
            samplers[i] = makeSampler(*context, Sampler(i));
    for (const Resource& r : resources) {
        if (r.slot == ~0u || !slots[r.slot].fresh || r.firstPass == ~0u) continue;
        Slot& slot = slots[r.slot];
        const gpu::MemoryRange* range = slot.bucket == ~0u ? nullptr : &buckets[slot.bucket].range;
        for (uint32_t half = 0; half < (slot.isHistory ? 2u : 1u); ++half) {
            if (slot.isImage)
                slot.halves[half].image = std::make_unique<gpu::Image>(*context, descOf(slot), range);
            else
                slot.halves[half].buffer = std::make_unique<gpu::Buffer>(*context, descOf(slot, slot.buffer));
            slot.halves[half].needsZero = slot.isHistory;
            // What was freed there has ended, as the host has waited for it; validation does not follow
            // timelines.
            slot.halves[half].sync.fill(kTakenOver);
        }
        slot.fresh = false;
    }
}

void FrameGraph::Impl::zeroNewHistories(VkCommandBuffer commands) {
    for (Slot& slot : slots) {
        for (Memory& half : slot.halves) {
            if (!std::exchange(half.needsZero, false)) continue;
            Resource r{.name = slot.name,
                       .isImage = slot.isImage,
                       .slot = uint32_t(&slot - slots.data()),
                       .half = uint32_t(&half - slot.halves.data())};
            addBarrier(r, accessOf(UseKind::kTransferWrite), true, nullptr);
            flushBarriers(commands);
            if (half.buffer) {
                context->vk().CmdFillBuffer(commands, half.buffer->handle(), 0, VK_WHOLE_SIZE, 0);
                continue;
            }
            const VkClearColorValue zero{};
            const VkImageSubresourceRange all{half.image->aspect(), 0, VK_REMAINING_MIP_LEVELS, 0,
                                              VK_REMAINING_ARRAY_LAYERS};
            context->vk().CmdClearColorImage(commands, half.image->handle(),
                                             VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &zero, 1, &all);
        }
    }
}

const gpu::Image& FrameGraph::Impl::imageOf(const Resource& r) const {
    if (r.kind == ResourceKind::kImport) return *r.importedImage;
    const gpu::Image* const image = imageIn(slots[r.slot].halves[r.half]);
    AG_CHECK_MSG(image != nullptr, std::string(r.name));
    return *image;
}

const gpu::Buffer& FrameGraph::Impl::bufferOf(const Resource& r) const {
    if (r.kind == ResourceKind::kImport) return *r.importedBuffer;
    const gpu::Buffer* const buffer = bufferIn(slots[r.slot].halves[r.half]);
    AG_CHECK_MSG(buffer != nullptr, std::string(r.name));
    return *buffer;
}

}  // namespace ag
