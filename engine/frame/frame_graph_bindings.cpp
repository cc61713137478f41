// What a pass binds: checked against its shaders, written to descriptor sets.
#include <algorithm>
#include <array>

#include "engine/core/failure.h"
#include "engine/frame/frame_graph_impl.h"

namespace ag {
namespace {

constexpr size_t kMostBindings = 32;  // of a pass
constexpr uint32_t kSetsPerPool = 256;
constexpr size_t kMostSets = 8192;  // then the cache starts anew

bool isBuffer(gpu::BindingKind kind) {
    return kind != gpu::BindingKind::kSampledImage && kind != gpu::BindingKind::kStorageImage;
}

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

VkDescriptorSet tryAllocate(gpu::Context& context, VkDescriptorPool pool, VkDescriptorSetLayout layout) {
    const VkDescriptorSetAllocateInfo info{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
                                           .descriptorPool = pool,
                                           .descriptorSetCount = 1,
                                           .pSetLayouts = &layout};
    VkDescriptorSet set = VK_NULL_HANDLE;
    return context.vk().AllocateDescriptorSets(context.handle(), &info, &set) == VK_SUCCESS ? set
                                                                                            : VK_NULL_HANDLE;
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

}  // namespace

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

VkDescriptorSet FrameGraph::Impl::allocateSet(VkDescriptorSetLayout layout) {
    if (sets.size() >= kMostSets) {
        for (VkDescriptorPool pool : pools)
            context->retire([d = context, pool] {
                d->vk().DestroyDescriptorPool(d->handle(), pool, d->hostAllocation());
            });
        pools.clear();
        sets.clear();
    }
    VkDescriptorSet set = pools.empty() ? VK_NULL_HANDLE : tryAllocate(*context, pools.back(), layout);
    if (!set) {
        pools.reserve(pools.size() + 1);  // no pool is lost where its row cannot be had
        pools.push_back(makePool(*context));
        set = tryAllocate(*context, pools.back(), layout);
    }
    AG_CHECK(set != VK_NULL_HANDLE);
    return set;
}

void FrameGraph::Impl::writeSet(VkDescriptorSet set, std::span<const gpu::ShaderBinding> bindings,
                                std::span<const Use* const> bound) const {
    std::array<VkDescriptorBufferInfo, kMostBindings> bufferInfos{};
    std::array<VkDescriptorImageInfo, kMostBindings> imageInfos{};
    std::array<VkBufferView, kMostBindings> views{};
    std::array<VkWriteDescriptorSet, kMostBindings> writes{};
    for (size_t i = 0; i < bindings.size(); ++i) {
        const Use& use = *bound[i];
        const Resource& r = resources[use.resource];
        writes[i] = {.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                     .dstSet = set,
                     .dstBinding = bindings[i].binding,
                     .descriptorCount = 1,
                     .descriptorType = gpu::descriptorType(bindings[i].kind),
                     .pImageInfo = &imageInfos[i],
                     .pBufferInfo = &bufferInfos[i],
                     .pTexelBufferView = &views[i]};
        if (r.isImage) {
            const gpu::Image& image = imageOf(r);
            const bool sampled = bindings[i].kind == gpu::BindingKind::kSampledImage;
            imageInfos[i] = {sampled ? samplers[size_t(use.sampler)] : VK_NULL_HANDLE,
                             use.wholeImage ? image.view() : image.mipView(use.mip),
                             accessOf(use.kind).layout};
        } else {
            const gpu::Buffer& buffer = bufferOf(r);
            checkRange(context->info().limits, bindings[i].kind, buffer.desc());
            bufferInfos[i] = {buffer.handle(), 0, VK_WHOLE_SIZE};
            views[i] = buffer.texelView();
        }
    }
    context->vk().UpdateDescriptorSets(context->handle(), uint32_t(bindings.size()), writes.data(), 0,
                                       nullptr);
}

// Sets are written once and found again by what they bind (ids are never reused, so a stale one is never
// found).
VkDescriptorSet FrameGraph::Impl::descriptorSet(const Pass& pass, const gpu::Pipeline& pipeline) {
    if (pipeline.bindings.empty()) return VK_NULL_HANDLE;
    AG_CHECK_LE(pipeline.bindings.size(), kMostBindings);
    std::array<const Use*, kMostBindings> bound{};
    const std::span<const Use> all = usesOf(pass);
    uint64_t key = uint64_t(pipeline.setLayout);
    for (size_t i = 0; i < pipeline.bindings.size(); ++i) {
        const auto use = std::ranges::find(all, pipeline.bindings[i].name, &Use::name);
        AG_CHECK_MSG(use != all.end(), pipeline.bindings[i].name);
        const Resource& r = resources[use->resource];
        bound[i] = &*use;
        key = combineHash(key, r.isImage ? imageOf(r).id() : bufferOf(r).id());
        key = combineHash(key, (uint64_t(use->sampler) << 32) | (uint64_t(use->wholeImage) << 16) | use->mip);
        key = combineHash(key, uint64_t(accessOf(use->kind).layout));
    }
    if (const auto found = sets.find(key); found != sets.end()) return found->second;
    const VkDescriptorSet set = allocateSet(pipeline.setLayout);
    context->setDebugName(VK_OBJECT_TYPE_DESCRIPTOR_SET, set, std::string(pass.name));
    writeSet(set, pipeline.bindings, bound);
    sets.emplace(key, set);
    return set;
}

}  // namespace ag
