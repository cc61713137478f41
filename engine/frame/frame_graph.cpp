// Declaring a frame: resources, passes, uses. Nothing here touches the device.
#include "engine/frame/frame_graph.h"

#include <algorithm>

#include "engine/frame/frame_graph_impl.h"

namespace ag {

FrameGraph::FrameGraph(gpu::Device* device, gpu::PipelineLibrary* pipelines) : impl_(new Impl) {
    AG_CHECK_EQ(device == nullptr, pipelines == nullptr);
    impl_->device = device;
    impl_->pipelines = pipelines;
    if (!device) return;
    impl_->timer = std::make_unique<FrameTimer>(*device);
    if (device->info().counts) impl_->counter = std::make_unique<PassCounter>(*device);
    impl_->spans.reserve(FrameTimer::kMaxPasses);
    const VkCommandPoolCreateInfo pool{.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                       .flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT,
                                       .queueFamilyIndex = device->queueFamily()};
    AG_VK(vkCreateCommandPool(device->handle(), &pool, nullptr, &impl_->ownPool));
    device->setDebugName(VK_OBJECT_TYPE_COMMAND_POOL, impl_->ownPool, "frame_graph.alone");
}

FrameGraph::~FrameGraph() {
    if (!impl_->device) return;
    const VkDevice device = impl_->device->handle();
    impl_->device->waitIdle();
    for (VkDescriptorPool pool : impl_->pools)
        vkDestroyDescriptorPool(device, pool, nullptr);
    for (VkSampler sampler : impl_->samplers)
        vkDestroySampler(device, sampler, nullptr);
    vkDestroyCommandPool(device, impl_->ownPool, nullptr);
    impl_->slots.clear();
    impl_->device->collect();
    for (AliasBucket& bucket : impl_->buckets)
        if (bucket.range) impl_->device->memory().free(bucket.range);
}

void FrameGraph::beginFrame(const FrameGraphOptions& options) {
    impl_->options = options;
    impl_->holding = false;
    ++impl_->frame;
    impl_->resources.clear();
    impl_->passes.clear();
    impl_->uses.clear();
    impl_->draws.clear();
    impl_->parts.clear();
    impl_->data.clear();
}

namespace {

bool same(const ImageInfo& a, const ImageInfo& b) {
    return a.format == b.format && a.size == b.size && a.mips == b.mips && a.lifetime == b.lifetime;
}

bool same(const BufferInfo& a, const BufferInfo& b) {
    return a.sizeBytes == b.sizeBytes && a.texelFormat == b.texelFormat && a.indirect == b.indirect &&
           a.vertices == b.vertices && a.hostVisible == b.hostVisible;
}

}  // namespace

uint32_t FrameGraph::Impl::declare(std::string_view name, bool isImage, const ImageInfo& image,
                                   const BufferInfo& buffer, bool history) {
    const uint64_t hash = hashText(name);
    const auto [entry, added] = slotOfName.try_emplace(hash, uint32_t(slots.size()));
    if (added) {
        slots.emplace_back();
        slots.back().nameHash = hash;
        slots.back().name = name;
    }
    Slot& slot = slots[entry->second];
    AG_CHECK_MSG(slot.lastFrame != frame, "resource declared twice in a frame: " + slot.name);
    slot.lastFrame = frame;
    const bool unchanged = !added && slot.isImage == isImage && slot.isHistory == history &&
                           (isImage ? same(slot.image, image) : same(slot.buffer, buffer));
    if (!unchanged) {
        bucketsStale =
            bucketsStale || slot.bucket != ~0u || (isImage && image.lifetime == Lifetime::kScratch);
        retireMemory(slot);
        slot.isImage = isImage;
        slot.isHistory = history;
        slot.image = image;
        slot.buffer = buffer;
    }
    Resource resource{
        .name = name, .isImage = isImage, .image = image, .buffer = buffer, .slot = entry->second};
    resources.push_back(resource);
    return uint32_t(resources.size() - 1);
}

uint32_t FrameGraph::Impl::import(Resource resource) {
    AG_CHECK(resource.importVersion != 0);
    resource.kind = ResourceKind::kImport;
    resources.push_back(resource);
    return uint32_t(resources.size() - 1);
}

ImageHandle FrameGraph::image(std::string_view name, const ImageInfo& info) {
    return {impl_->declare(name, true, info, {}, false)};
}

BufferHandle FrameGraph::buffer(std::string_view name, const BufferInfo& info) {
    return {impl_->declare(name, false, {}, info, false)};
}

HistoryImage FrameGraph::historyImage(std::string_view name, const ImageInfo& info) {
    const uint32_t current = impl_->declare(name, true, info, {}, true);
    Resource previous = impl_->resources[current];
    previous.kind = ResourceKind::kHistoryPrevious;
    impl_->resources.push_back(previous);
    const Slot& slot = impl_->slots[previous.slot];
    return {{current}, {current + 1}, slot.halves[slot.current].version != 0};
}

HistoryBuffer FrameGraph::historyBuffer(std::string_view name, const BufferInfo& info) {
    const uint32_t current = impl_->declare(name, false, {}, info, true);
    Resource previous = impl_->resources[current];
    previous.kind = ResourceKind::kHistoryPrevious;
    impl_->resources.push_back(previous);
    const Slot& slot = impl_->slots[previous.slot];
    return {{current}, {current + 1}, slot.halves[slot.current].version != 0};
}

void FrameGraph::resetHistory(std::string_view name) {
    const auto found = impl_->slotOfName.find(hashText(name));
    if (found == impl_->slotOfName.end()) return;
    Slot& slot = impl_->slots[found->second];
    for (Memory& half : slot.halves) {
        half.version = 0;
        half.needsZero = half.image || half.buffer;
    }
    slot.stepKey = 0;
}

ImageHandle FrameGraph::importImage(std::string_view name, const gpu::Image& image, uint64_t version,
                                    VkImageLayout layout) {
    const ImageInfo info{.format = image.desc().format, .size = image.desc().size, .mips = image.desc().mips};
    return {impl_->import({.name = name,
                           .isImage = true,
                           .image = info,
                           .importedImage = &image,
                           .importVersion = version,
                           .outputLayout = layout})};
}

BufferHandle FrameGraph::importBuffer(std::string_view name, const gpu::Buffer& buffer, uint64_t version) {
    const BufferInfo info{.sizeBytes = buffer.sizeBytes(), .texelFormat = buffer.desc().texelFormat};
    return {
        impl_->import({.name = name, .buffer = info, .importedBuffer = &buffer, .importVersion = version})};
}

ImageHandle FrameGraph::importImage(std::string_view name, const ImageInfo& info, uint64_t version) {
    return {impl_->import({.name = name, .isImage = true, .image = info, .importVersion = version})};
}

BufferHandle FrameGraph::importBuffer(std::string_view name, const BufferInfo& info, uint64_t version) {
    return {impl_->import({.name = name, .buffer = info, .importVersion = version})};
}

const ImageInfo& FrameGraph::info(ImageHandle image) const {
    return impl_->resources[image.index].image;
}
const BufferInfo& FrameGraph::info(BufferHandle buffer) const {
    return impl_->resources[buffer.index].buffer;
}

uint32_t FrameGraph::Impl::statsFor(std::string_view name) {
    const auto [entry, added] = statsOfName.try_emplace(hashText(name), uint32_t(stats.size()));
    if (added) stats.push_back({.nameHash = entry->first, .name = name});
    return entry->second;
}

Pass& FrameGraph::Impl::addPass(std::string_view name, PassKind kind) {
    Pass pass;
    pass.name = name;
    pass.kind = kind;
    pass.firstUse = uint32_t(uses.size());
    pass.firstDraw = uint32_t(draws.size());
    pass.stats = statsFor(name);
    pass.held = holding;
    for (const Pass& other : passes)
        AG_CHECK_MSG(other.stats != pass.stats, "pass added twice: " + std::string(name));
    passes.push_back(pass);
    return passes.back();
}

void FrameGraph::Impl::addUse(const Use& use) {
    AG_CHECK_LT(use.resource, resources.size());
    AG_CHECK_MSG(!passes.empty(), "declare a pass first");
    const Resource& resource = resources[use.resource];
    AG_CHECK_MSG(!writes(use.kind) || resource.kind == ResourceKind::kOwned,
                 std::string(resource.name) + " is read-only here");
    uses.push_back(use);
    ++passes.back().useCount;
}

void FrameGraph::hold(bool on) {
    impl_->holding = on;
}
bool FrameGraph::holding() const {
    return impl_->holding;
}

PassBuilder FrameGraph::compute(std::string_view name, std::string_view shader) {
    impl_->addPass(name, PassKind::kCompute).shader = shader;
    return PassBuilder(*this);
}

PassBuilder FrameGraph::fullscreen(std::string_view name, std::string_view fragmentShader) {
    Pass& pass = impl_->addPass(name, PassKind::kFullscreen);
    pass.vertexShader = "common/fullscreen.vert";
    pass.shader = fragmentShader;
    return PassBuilder(*this);
}

PassBuilder FrameGraph::raster(std::string_view name, std::string_view vertexShader,
                               std::string_view fragmentShader, gpu::VertexLayout layout) {
    Pass& pass = impl_->addPass(name, PassKind::kRaster);
    pass.vertexShader = vertexShader;
    pass.shader = fragmentShader;
    pass.raster.vertexLayout = layout;
    return PassBuilder(*this);
}

void FrameGraph::fill(std::string_view name, BufferHandle buffer, uint32_t word) {
    impl_->addPass(name, PassKind::kFill).fillWord = word;
    impl_->addUse({.resource = buffer.index, .kind = UseKind::kTransferWrite});
}

void FrameGraph::upload(std::string_view name, BufferHandle buffer, std::span<const std::byte> bytes) {
    AG_CHECK_EQ(bytes.size() % 4, size_t(0));
    Pass& pass = impl_->addPass(name, PassKind::kUpload);
    pass.dataOffset = uint32_t(impl_->data.size());
    pass.dataSize = uint32_t(bytes.size());
    impl_->data.insert(impl_->data.end(), bytes.begin(), bytes.end());
    impl_->addUse({.resource = buffer.index, .kind = UseKind::kTransferWrite});
}

void FrameGraph::copyImage(std::string_view name, ImageHandle from, ImageHandle to) {
    impl_->addPass(name, PassKind::kCopyImage);
    impl_->addUse({.resource = from.index, .kind = UseKind::kTransferRead});
    impl_->addUse({.resource = to.index, .kind = UseKind::kTransferWrite});
}

std::span<const std::byte> FrameGraph::readBack(const std::array<std::string_view, kFramesInFlight>& names,
                                                BufferHandle from) {
    const std::string_view name = names[impl_->frame % kFramesInFlight];
    const BufferHandle copy =
        buffer(name, {.sizeBytes = impl_->resources[from.index].buffer.sizeBytes, .hostVisible = true});
    impl_->addPass(name, PassKind::kCopyBuffer);
    impl_->addUse({.resource = from.index, .kind = UseKind::kTransferRead});
    impl_->addUse({.resource = copy.index, .kind = UseKind::kTransferWrite});
    output(copy);
    const Resource& resource = impl_->resources[copy.index];
    const Memory& memory = impl_->slots[resource.slot].halves[0];
    if (memory.version == 0 || !memory.buffer) return {};
    return {memory.buffer->mapped(), resource.buffer.sizeBytes};
}

void FrameGraph::output(ImageHandle image, VkImageLayout layout) {
    Resource& resource = impl_->resources[image.index];
    resource.isOutput = true;
    resource.outputLayout = layout;
}

void FrameGraph::output(BufferHandle buffer) {
    impl_->resources[buffer.index].isOutput = true;
}

}  // namespace ag
