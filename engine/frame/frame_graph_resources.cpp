// Device objects behind the declared resources: memory, samplers, descriptor sets.
#include <algorithm>
#include <array>

#include "engine/core/failure.h"
#include "engine/frame/frame_graph_impl.h"
#include "engine/gpu/retire.h"

namespace ag {
namespace {

constexpr uint64_t kFramesKept = 16;  // a resource not declared for so long is given back
constexpr uint32_t kSetsPerPool = 256;
constexpr size_t kMostSets = 8192;  // then the cache starts anew

gpu::ImageDesc descOf(const Slot& slot) {
    return {.name = slot.name, .format = slot.image.format, .size = slot.image.size, .mips = slot.image.mips};
}

gpu::BufferDesc descOf(const Slot& slot, const BufferInfo& info) {
    return {.name = slot.name,
            .sizeBytes = std::max<uint64_t>(info.sizeBytes, 16),
            .hostVisible = info.hostVisible,
            .indirect = info.indirect,
            .vertexOrIndex = info.vertices,
            .texelFormat = info.texelFormat};
}

VkSampler makeSampler(gpu::Context& context, Sampler kind) {
    const bool repeat = kind == Sampler::kLinearRepeat || kind == Sampler::kTrilinearRepeat;
    const VkFilter filter = kind == Sampler::kNearestClamp ? VK_FILTER_NEAREST : VK_FILTER_LINEAR;
    const VkSamplerAddressMode mode =
        repeat ? VK_SAMPLER_ADDRESS_MODE_REPEAT : VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    const bool mips = kind == Sampler::kTrilinearRepeat;
    const VkSamplerCreateInfo info{
        .sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO,
        .magFilter = filter,
        .minFilter = filter,
        .mipmapMode = mips ? VK_SAMPLER_MIPMAP_MODE_LINEAR : VK_SAMPLER_MIPMAP_MODE_NEAREST,
        .addressModeU = mode,
        .addressModeV = mode,
        .addressModeW = mode,
        .maxLod = mips ? VK_LOD_CLAMP_NONE : 0.25f};
    VkSampler sampler = VK_NULL_HANDLE;
    AG_VK(context.vk().CreateSampler(context.handle(), &info, context.hostAllocation(), &sampler));
    constexpr const char* kNames[] = {"sampler.nearest_clamp", "sampler.linear_clamp",
                                      "sampler.linear_repeat", "sampler.trilinear_repeat"};
    context.setDebugName(VK_OBJECT_TYPE_SAMPLER, sampler, kNames[size_t(kind)]);
    return sampler;
}

bool isBuffer(gpu::BindingKind kind) {
    return kind != gpu::BindingKind::kSampledImage && kind != gpu::BindingKind::kStorageImage;
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
        if (b == ~0u) {
            bucketsStale = true;
            continue;
        }
        overlap = overlap || r.firstPass + 1 <= buckets[b].busyUntil;
        buckets[b].busyUntil = std::max(buckets[b].busyUntil, r.lastPass + 1);
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
        uint32_t found = 0;
        while (found < buckets.size() && (!options.alias || r.firstPass + 1 <= buckets[found].busyUntil))
            ++found;
        if (found == buckets.size()) buckets.emplace_back();
        AliasBucket& bucket = buckets[found];
        bucket.busyUntil = r.lastPass + 1;
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

void FrameGraph::Impl::checkBindings(const Pass& pass, const gpu::Pipeline& pipeline) {
    const std::string where =
        "pass " + std::string(pass.name) + ", shader " + std::string(pass.shader) + ": ";
    for (const Use& use : usesOf(pass)) {
        if (use.name.empty()) continue;
        const auto b = std::ranges::find(pipeline.bindings, use.name, &gpu::ShaderBinding::name);
        const std::string what = where + std::string(use.name);
        if (b == pipeline.bindings.end())
            fail(FailureKind::kMistake, what + " is declared but the shader has no such binding");
        const Resource& r = resources[use.resource];
        if (isBuffer(b->kind) == r.isImage)
            fail(FailureKind::kMistake, what + " is a buffer on one side and an image on the other");
        if (writes(use.kind) && !b->writes)
            fail(FailureKind::kMistake, what + " is declared written but the shader only reads it");
        if (!writes(use.kind) && b->writes)
            fail(FailureKind::kMistake, what + " is declared read but the shader writes it");
        const bool texel = b->kind == gpu::BindingKind::kUniformTexelBuffer ||
                           b->kind == gpu::BindingKind::kStorageTexelBuffer;
        if (texel && r.buffer.texelFormat == VK_FORMAT_UNDEFINED)
            fail(FailureKind::kMistake, what + " needs a buffer with a texel format");
    }
    for (const gpu::ShaderBinding& b : pipeline.bindings)
        if (std::ranges::find(usesOf(pass), b.name, &Use::name) == usesOf(pass).end())
            fail(FailureKind::kMistake, where + "binding " + b.name + " is not declared");
    if (pass.kind == PassKind::kCompute && pass.pushSizeBytes != pipeline.pushSizeBytes)
        fail(FailureKind::kMistake, where + "pushes " + std::to_string(pass.pushSizeBytes) +
                                        " bytes, the shader takes " + std::to_string(pipeline.pushSizeBytes));
}

namespace {

VkDescriptorPool makePool(gpu::Context& context) {
    constexpr std::array kTypes = {
        VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER,         VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
        VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER,   VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER,
        VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE};
    std::array<VkDescriptorPoolSize, kTypes.size()> sizes{};
    for (size_t i = 0; i < kTypes.size(); ++i)
        sizes[i] = {kTypes[i], kSetsPerPool * 10};
    const VkDescriptorPoolCreateInfo info{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                                          .maxSets = kSetsPerPool,
                                          .poolSizeCount = uint32_t(sizes.size()),
                                          .pPoolSizes = sizes.data()};
    VkDescriptorPool pool = VK_NULL_HANDLE;
    AG_VK(context.vk().CreateDescriptorPool(context.handle(), &info, context.hostAllocation(), &pool));
    context.setDebugName(VK_OBJECT_TYPE_DESCRIPTOR_POOL, pool, "frame_graph.sets");
    return pool;
}

void checkRange(const VkPhysicalDeviceLimits& limits, gpu::BindingKind kind, const gpu::BufferDesc& buffer) {
    const auto check = [&](const char* limit, uint32_t most) {
        if (buffer.sizeBytes > most)
            gpu::failBeyondLimit("the buffer " + buffer.name, limit, buffer.sizeBytes, most);
    };
    if (kind == gpu::BindingKind::kStorageBuffer)
        check("maxStorageBufferRange", limits.maxStorageBufferRange);
    if (kind == gpu::BindingKind::kUniformBuffer)
        check("maxUniformBufferRange", limits.maxUniformBufferRange);
}

VkDescriptorSet tryAllocate(gpu::Context& context, VkDescriptorPool pool, VkDescriptorSetLayout layout) {
    const VkDescriptorSetAllocateInfo info{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
                                           .descriptorPool = pool,
                                           .descriptorSetCount = 1,
                                           .pSetLayouts = &layout};
    VkDescriptorSet set = VK_NULL_HANDLE;
    return context.vk().AllocateDescriptorSets(context.handle(), &info, &set) == VK_SUCCESS ? set
                                                                                            : VK_NULL_HANDLE;
}

}  // namespace

// Sets are written once and found again by what they bind (ids are never reused, so a stale one is never
// found).
VkDescriptorSet FrameGraph::Impl::descriptorSet(const Pass& pass, const gpu::Pipeline& pipeline) {
    if (pipeline.bindings.empty()) return VK_NULL_HANDLE;
    constexpr size_t kMostBindings = 24;
    AG_CHECK_LE(pipeline.bindings.size(), kMostBindings);
    std::array<const Use*, kMostBindings> bound{};
    uint64_t key = uint64_t(pipeline.setLayout);
    for (size_t i = 0; i < pipeline.bindings.size(); ++i) {
        const auto uses_ = usesOf(pass);
        const auto use = std::ranges::find(uses_, pipeline.bindings[i].name, &Use::name);
        AG_CHECK_MSG(use != uses_.end(), pipeline.bindings[i].name);
        const Resource& r = resources[use->resource];
        bound[i] = &*use;
        key = combineHash(key, r.isImage ? imageOf(r).id() : bufferOf(r).id());
        key = combineHash(key, (uint64_t(use->sampler) << 32) | (uint64_t(use->wholeImage) << 16) | use->mip);
        key = combineHash(key, uint64_t(accessOf(use->kind).layout));
    }
    if (const auto found = sets.find(key); found != sets.end()) return found->second;
    if (sets.size() >= kMostSets) {
        for (VkDescriptorPool pool : pools)
            context->retire([d = context, pool] {
                d->vk().DestroyDescriptorPool(d->handle(), pool, d->hostAllocation());
            });
        pools.clear();
        sets.clear();
    }

    VkDescriptorSet set =
        pools.empty() ? VK_NULL_HANDLE : tryAllocate(*context, pools.back(), pipeline.setLayout);
    if (!set) {
        pools.reserve(pools.size() + 1);  // no pool is lost where its row cannot be had
        pools.push_back(makePool(*context));
        set = tryAllocate(*context, pools.back(), pipeline.setLayout);
    }
    AG_CHECK(set != VK_NULL_HANDLE);
    context->setDebugName(VK_OBJECT_TYPE_DESCRIPTOR_SET, set, std::string(pass.name));
    std::array<VkDescriptorBufferInfo, kMostBindings> bufferInfos{};
    std::array<VkDescriptorImageInfo, kMostBindings> imageInfos{};
    std::array<VkBufferView, kMostBindings> views{};
    std::array<VkWriteDescriptorSet, kMostBindings> writes_{};
    for (size_t i = 0; i < pipeline.bindings.size(); ++i) {
        const gpu::ShaderBinding& b = pipeline.bindings[i];
        const Resource& r = resources[bound[i]->resource];
        writes_[i] = {.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                      .dstSet = set,
                      .dstBinding = b.binding,
                      .descriptorCount = 1,
                      .descriptorType = gpu::descriptorType(b.kind),
                      .pImageInfo = &imageInfos[i],
                      .pBufferInfo = &bufferInfos[i],
                      .pTexelBufferView = &views[i]};
        if (r.isImage) {
            const gpu::Image& image = imageOf(r);
            const bool sampled = b.kind == gpu::BindingKind::kSampledImage;
            imageInfos[i] = {sampled ? samplers[size_t(bound[i]->sampler)] : VK_NULL_HANDLE,
                             bound[i]->wholeImage ? image.view() : image.mipView(bound[i]->mip),
                             accessOf(bound[i]->kind).layout};
        } else {
            const gpu::Buffer& buffer = bufferOf(r);
            checkRange(context->info().limits, b.kind, buffer.desc());
            bufferInfos[i] = {buffer.handle(), 0, VK_WHOLE_SIZE};
            views[i] = buffer.texelView();
        }
    }
    context->vk().UpdateDescriptorSets(context->handle(), uint32_t(pipeline.bindings.size()), writes_.data(),
                                       0, nullptr);
    sets.emplace(key, set);
    return set;
}

}  // namespace ag
