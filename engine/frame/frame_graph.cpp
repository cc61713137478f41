// Declaring a frame: resources, passes, uses. Nothing here touches the device.
#include "engine/frame/frame_graph.h"

#include <algorithm>

#include "engine/frame/frame_graph_impl.h"

namespace ag {

FrameGraph::FrameGraph(gpu::Context* context, gpu::PipelineLibrary* pipelines)
    : GraphScope(*this, 0), impl_(new Impl) {
    AG_CHECK_EQ(context == nullptr, pipelines == nullptr);
    impl_->context = context;
    impl_->pipelines = pipelines;
    if (context) impl_->spans.reserve(FrameTimer::kMaxPasses);
}

FrameGraph::~FrameGraph() {
    gpu::Context* const context = impl_->context;
    if (!context) return;
    for (VkDescriptorPool pool : impl_->pools)
        context->vk().DestroyDescriptorPool(context->handle(), pool, context->hostAllocation());
    for (VkSampler sampler : impl_->samplers)
        context->vk().DestroySampler(context->handle(), sampler, context->hostAllocation());
    impl_->slots.clear();
    for (AliasBucket& bucket : impl_->buckets)
        if (bucket.range) context->memory().free(bucket.range);
}

void FrameGraph::beginFrame(const FrameGraphOptions& options) {
    impl_->options = options;
    ++impl_->frame;
    impl_->resources.clear();
    impl_->passes.clear();
    impl_->uses.clear();
    impl_->draws.clear();
    impl_->parts.clear();
    impl_->partSources.clear();
    impl_->data.clear();
    impl_->callbacks.clear();
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

uint32_t FrameGraph::Impl::declare(Resource resource, bool history) {
    const uint64_t hash = hashName(resource.scope, resource.name);
    const auto [entry, added] = slotOfName.try_emplace(hash, uint32_t(slots.size()));
    if (added)
        slots.emplace_back(Slot{.scope = resource.scope, .name = fullName(resource.scope, resource.name)});
    Slot& slot = slots[entry->second];
    AG_CHECK_MSG(slot.lastFrame != frame, "resource declared twice in a frame: " + slot.name);
    slot.lastFrame = frame;
    const bool unchanged =
        !added && slot.isImage == resource.isImage && slot.isHistory == history &&
        (slot.isImage ? same(slot.image, resource.image) : same(slot.buffer, resource.buffer));
    if (!unchanged) {
        bucketsStale = bucketsStale || slot.bucket != ~0u ||
                       (resource.isImage && resource.image.lifetime == Lifetime::kScratch);
        retireMemory(slot);
        slot.isImage = resource.isImage;
        slot.isHistory = history;
        slot.image = resource.image;
        slot.buffer = resource.buffer;
    }
    resource.slot = entry->second;
    resources.push_back(resource);
    return uint32_t(resources.size() - 1);
}

// The current half; the previous one is the resource after it.
uint32_t FrameGraph::Impl::declareHistory(Resource resource) {
    const uint32_t current = declare(resource, true);
    Resource previous = resources[current];
    previous.kind = ResourceKind::kHistoryPrevious;
    resources.push_back(previous);
    return current;
}

uint32_t FrameGraph::Impl::import(Resource resource) {
    AG_CHECK(resource.importVersion != 0);
    resource.kind = ResourceKind::kImport;
    resources.push_back(resource);
    return uint32_t(resources.size() - 1);
}

ImageHandle GraphScope::image(std::string_view name, const ImageInfo& info) const {
    return {graph_->impl_->declare({.name = name, .scope = id_, .isImage = true, .image = info}, false)};
}

BufferHandle GraphScope::buffer(std::string_view name, const BufferInfo& info) const {
    return {graph_->impl_->declare({.name = name, .scope = id_, .buffer = info}, false)};
}

HistoryImage GraphScope::historyImage(std::string_view name, const ImageInfo& info) const {
    FrameGraph::Impl& g = *graph_->impl_;
    const uint32_t current = g.declareHistory({.name = name, .scope = id_, .isImage = true, .image = info});
    return {{current}, {current + 1}, g.newest(g.resources[current]).version != 0};
}

HistoryBuffer GraphScope::historyBuffer(std::string_view name, const BufferInfo& info) const {
    FrameGraph::Impl& g = *graph_->impl_;
    const uint32_t current = g.declareHistory({.name = name, .scope = id_, .buffer = info});
    return {{current}, {current + 1}, g.newest(g.resources[current]).version != 0};
}

ImageHandle GraphScope::importImage(std::string_view name, const gpu::Image& image, uint64_t version,
                                    VkImageLayout layout) const {
    const ImageInfo info{.format = image.desc().format, .size = image.desc().size, .mips = image.desc().mips};
    return {graph_->impl_->import({.name = name,
                                   .scope = id_,
                                   .isImage = true,
                                   .image = info,
                                   .importedImage = &image,
                                   .importVersion = version,
                                   .outputLayout = layout})};
}

BufferHandle GraphScope::importBuffer(std::string_view name, const gpu::Buffer& buffer,
                                      uint64_t version) const {
    const BufferInfo info{.sizeBytes = buffer.sizeBytes(), .texelFormat = buffer.desc().texelFormat};
    return {graph_->impl_->import(
        {.name = name, .scope = id_, .buffer = info, .importedBuffer = &buffer, .importVersion = version})};
}

// From here on the resource stands for the host's object: what was done to it before this frame is not known.
Memory& FrameGraph::Impl::borrow(uint32_t resource, const Borrowed& how) {
    Resource& r = resources[resource];
    Slot& slot = slots[r.slot];
    if (!how.untouched) forget(slot);
    slot.fresh = false;
    r.isOutput = true;
    r.outputLayout = how.after;
    Memory& memory = slot.halves[0];
    memory.borrowedImage = nullptr;
    memory.borrowedBuffer = nullptr;
    memory.sync.fill({.writeStages = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                      .writeAccess = VK_ACCESS_2_MEMORY_WRITE_BIT,
                      .readStages = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                      .layout = r.isImage ? how.before : VK_IMAGE_LAYOUT_UNDEFINED});
    return memory;
}

ImageHandle GraphScope::borrowImage(std::string_view name, const gpu::Image& image,
                                    const Borrowed& how) const {
    const ImageHandle handle =
        borrowImage(name, {.format = image.desc().format, .size = image.desc().size}, how);
    FrameGraph::Impl& g = *graph_->impl_;
    g.slots[g.resources[handle.index].slot].halves[0].borrowedImage = &image;
    return handle;
}

ImageHandle GraphScope::borrowImage(std::string_view name, const ImageInfo& info, const Borrowed& how) const {
    const ImageHandle handle = image(name, info);
    graph_->impl_->borrow(handle.index, how);
    return handle;
}

BufferHandle GraphScope::borrowBuffer(std::string_view name, const gpu::Buffer& borrowed,
                                      const Borrowed& how) const {
    const BufferHandle handle =
        buffer(name, {.sizeBytes = borrowed.sizeBytes(), .texelFormat = borrowed.desc().texelFormat});
    graph_->impl_->borrow(handle.index, how).borrowedBuffer = &borrowed;
    return handle;
}

ImageHandle GraphScope::importImage(std::string_view name, const ImageInfo& info, uint64_t version) const {
    return {graph_->impl_->import(
        {.name = name, .scope = id_, .isImage = true, .image = info, .importVersion = version})};
}

BufferHandle GraphScope::importBuffer(std::string_view name, const BufferInfo& info, uint64_t version) const {
    return {graph_->impl_->import({.name = name, .scope = id_, .buffer = info, .importVersion = version})};
}

bool GraphScope::isRead(BufferHandle buffer) const {
    return std::ranges::any_of(graph_->impl_->uses, [&](const Use& use) {
        return use.resource == buffer.index && readsOld(use.kind);
    });
}

bool GraphScope::wasWanted(std::string_view pass) const {
    const FrameGraph::Impl& impl = *graph_->impl_;
    const auto found = impl.statsOfName.find(hashName(id_, pass));
    return found != impl.statsOfName.end() && impl.framesRun > 0 &&
           impl.stats[found->second].wantedIn == impl.framesRun;
}

const ImageInfo& GraphScope::info(ImageHandle image) const {
    return graph_->impl_->resources[image.index].image;
}
const BufferInfo& GraphScope::info(BufferHandle buffer) const {
    return graph_->impl_->resources[buffer.index].buffer;
}

uint32_t FrameGraph::Impl::find(uint32_t scope, bool isImage, std::string_view name) const {
    for (uint32_t i = 0; i < resources.size(); ++i)
        if (resources[i].isImage == isImage && resources[i].scope == scope && resources[i].name == name)
            return i;
    return ~0u;
}

ImageHandle GraphScope::findImage(std::string_view name) const {
    return {graph_->impl_->find(id_, true, name)};
}

BufferHandle GraphScope::findBuffer(std::string_view name) const {
    return {graph_->impl_->find(id_, false, name)};
}

uint32_t FrameGraph::Impl::statsFor(uint32_t scope, std::string_view name) {
    const auto [entry, added] = statsOfName.try_emplace(hashName(scope, name), uint32_t(stats.size()));
    if (added) stats.emplace_back();
    PassStats& known = stats[entry->second];
    if (!known.fullName) {  // or its scope was removed, and another has taken its place
        known = {.nameHash = entry->first, .scope = scope};
        known.fullName = std::make_unique<const std::string>(fullName(scope, name));
    }
    return entry->second;
}

uint32_t FrameGraph::Impl::addPass(const GraphScope& scope, std::string_view name, PassKind kind) {
    Pass pass;
    pass.kind = kind;
    pass.firstUse = uint32_t(uses.size());
    pass.firstDraw = uint32_t(draws.size());
    pass.stats = statsFor(scope.id_, name);
    pass.name = *stats[pass.stats].fullName;
    pass.held = scope.held_;
    const bool compute = kind == PassKind::kCompute || kind == PassKind::kFill || kind == PassKind::kUpload ||
                         kind == PassKind::kCopyBuffer;
    pass.async = scope.async_ && compute;
    for (const Pass& other : passes)
        AG_CHECK_MSG(other.stats != pass.stats, "pass added twice: " + std::string(name));
    passes.push_back(pass);
    return uint32_t(passes.size() - 1);
}

// A pass's uses and draws lie together, so another one cannot be begun in between.
Pass& FrameGraph::Impl::declaring(uint32_t pass) {
    AG_CHECK_MSG(pass + 1 == passes.size(), "pass " + std::string(passes[pass].name) +
                                                " is declared on after " + std::string(passes.back().name) +
                                                " was begun");
    return passes[pass];
}

void FrameGraph::Impl::addUse(uint32_t pass, const Use& use) {
    AG_CHECK_LT(use.resource, resources.size());
    const Resource& resource = resources[use.resource];
    AG_CHECK_MSG(!writes(use.kind) || resource.kind == ResourceKind::kOwned,
                 std::string(resource.name) + " is read-only here");
    ++declaring(pass).useCount;
    uses.push_back(use);
}

PassBuilder GraphScope::compute(std::string_view name, std::string_view shader) const {
    FrameGraph::Impl& g = *graph_->impl_;
    const uint32_t pass = g.addPass(*this, name, PassKind::kCompute);
    g.passes[pass].shader = shader;
    return {*graph_, pass};
}

PassBuilder GraphScope::fullscreen(std::string_view name, std::string_view fragmentShader) const {
    FrameGraph::Impl& g = *graph_->impl_;
    const uint32_t pass = g.addPass(*this, name, PassKind::kFullscreen);
    g.passes[pass].vertexShader = "common/fullscreen.vert";
    g.passes[pass].shader = fragmentShader;
    return {*graph_, pass};
}

PassBuilder GraphScope::raster(std::string_view name, std::string_view vertexShader,
                               std::string_view fragmentShader, gpu::VertexLayout layout) const {
    FrameGraph::Impl& g = *graph_->impl_;
    const uint32_t pass = g.addPass(*this, name, PassKind::kRaster);
    g.passes[pass].vertexShader = vertexShader;
    g.passes[pass].shader = fragmentShader;
    g.passes[pass].raster.vertexLayout = layout;
    return {*graph_, pass};
}

PassBuilder GraphScope::callback(std::string_view name) const {
    return {*graph_, graph_->impl_->addPass(*this, name, PassKind::kCallback)};
}

void GraphScope::fill(std::string_view name, BufferHandle buffer, uint32_t word) const {
    FrameGraph::Impl& g = *graph_->impl_;
    const uint32_t pass = g.addPass(*this, name, PassKind::kFill);
    g.passes[pass].fillWord = word;
    g.addUse(pass, {.resource = buffer.index, .kind = UseKind::kTransferWrite});
}

void GraphScope::upload(std::string_view name, BufferHandle buffer, std::span<const std::byte> bytes) const {
    AG_CHECK_EQ(bytes.size() % 4, size_t(0));
    FrameGraph::Impl& g = *graph_->impl_;
    const uint32_t pass = g.addPass(*this, name, PassKind::kUpload);
    g.passes[pass].dataOffset = uint32_t(g.data.size());
    g.passes[pass].dataSize = uint32_t(bytes.size());
    g.data.insert(g.data.end(), bytes.begin(), bytes.end());
    g.addUse(pass, {.resource = buffer.index, .kind = UseKind::kTransferWrite});
}

void GraphScope::copyImage(std::string_view name, ImageHandle from, ImageHandle to) const {
    FrameGraph::Impl& g = *graph_->impl_;
    const uint32_t pass = g.addPass(*this, name, PassKind::kCopyImage);
    g.addUse(pass, {.resource = from.index, .kind = UseKind::kTransferRead});
    g.addUse(pass, {.resource = to.index, .kind = UseKind::kTransferWrite});
}

std::span<const std::byte> GraphScope::readBack(const std::array<std::string_view, kFramesInFlight>& names,
                                                BufferHandle from) const {
    FrameGraph::Impl& g = *graph_->impl_;
    const std::string_view name = names[g.frame % kFramesInFlight];
    const BufferHandle copy = buffer(name, {.sizeBytes = info(from).sizeBytes, .hostVisible = true});
    const uint32_t pass = g.addPass(*this, name, PassKind::kCopyBuffer);
    g.addUse(pass, {.resource = from.index, .kind = UseKind::kTransferRead});
    g.addUse(pass, {.resource = copy.index, .kind = UseKind::kTransferWrite});
    output(copy);
    const Memory& memory = g.newest(g.resources[copy.index]);
    if (memory.version == 0 || !memory.buffer) return {};
    return {memory.buffer->mapped(), info(copy).sizeBytes};
}

void GraphScope::output(ImageHandle image, VkImageLayout layout) const {
    Resource& resource = graph_->impl_->resources[image.index];
    resource.isOutput = true;
    resource.outputLayout = layout;
}

void GraphScope::output(BufferHandle buffer) const {
    graph_->impl_->resources[buffer.index].isOutput = true;
}

}  // namespace ag
