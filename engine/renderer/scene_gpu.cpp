#include "engine/renderer/scene_gpu.h"

#include <algorithm>
#include <cstring>

#include "engine/core/hash.h"
#include "engine/gpu/transfer.h"
#include "engine/renderer/light_clusters.h"
#include "gi/rsm.h"
#include "gi/surfaces.h"
#include "shaders/shadow_maps/shadow_maps_io.h"

namespace ag::render {
namespace {

io::Instance instanceRow(const RenderInstance& instance, const GeometryArrays& geometry) {
    if (!instance.isPresent()) return {.ids = {0, 0, kNoSkinnedMesh, 0}};
    const glm::mat3x4 rows = glm::transpose(instance.worldFromLocal);
    return {.worldFromLocal0 = rows[0],
            .worldFromLocal1 = rows[1],
            .worldFromLocal2 = rows[2],
            .ids = {geometry.primitives[instance.primitive].material, instance.primitive,
                    instance.skinnedMesh, 0}};
}

// Of the rows that changed those whose thing was there before: in `scratch`.
std::span<const RenderScene::Range> stillThere(const RenderScene& scene,
                                               std::vector<RenderScene::Range>& scratch) {
    scratch.clear();
    auto replaced = scene.replacedInstances.begin();
    for (RenderScene::Range range : scene.changedInstances) {
        for (; replaced != scene.replacedInstances.end() && replaced->begin < range.end; ++replaced) {
            if (range.begin < replaced->begin) scratch.push_back({range.begin, replaced->begin});
            range.begin = replaced->end;
        }
        if (range.begin < range.end) scratch.push_back(range);
    }
    return scratch;
}

enum class Transfer { kBefore, kBetweenCopies, kAfter };

void transferBarrier(const gpu::Functions& vk, VkCommandBuffer commands, Transfer when) {
    VkMemoryBarrier2 barrier{.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2};
    const bool before = when == Transfer::kBefore, after = when == Transfer::kAfter;
    barrier.srcStageMask = before ? VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT : VK_PIPELINE_STAGE_2_COPY_BIT;
    barrier.srcAccessMask = before ? VK_ACCESS_2_NONE : VK_ACCESS_2_TRANSFER_WRITE_BIT;
    barrier.dstStageMask = after ? VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT : VK_PIPELINE_STAGE_2_COPY_BIT;
    barrier.dstAccessMask = after ? VK_ACCESS_2_MEMORY_READ_BIT : VK_ACCESS_2_TRANSFER_WRITE_BIT;
    const VkDependencyInfo info{
        .sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO, .memoryBarrierCount = 1, .pMemoryBarriers = &barrier};
    vk.CmdPipelineBarrier2(commands, &info);
}

}  // namespace

SceneGpu::SceneGpu(gpu::Device& device)
    : device_(device), skin_(device), trees_(device), points_(device), sky_(device) {}
SceneGpu::~SceneGpu() {
    device_.waitIdle();
}

void SceneGpu::load(const GeometryArrays& geometry) {
    device_.waitIdle();
    positions_ =
        gpu::loadBuffer(device_, {.name = "scene.positions", .vertexOrIndex = true}, geometry.positions);
    attributes_ =
        gpu::loadBuffer(device_, {.name = "scene.attributes", .vertexOrIndex = true}, geometry.attributes);
    indices_ = gpu::loadBuffer(device_, {.name = "scene.indices", .vertexOrIndex = true}, geometry.indices);
    skin_.load(geometry);
    points_.load(geometry);
    ++loads_;
    noteTextures(geometry);
    loadTextures(geometry);
    useUnits(geometry, {});
    geometryVersion_ = geometry.version;
}

std::unique_ptr<gpu::Buffer> SceneGpu::grown(std::unique_ptr<gpu::Buffer> old, const char* name,
                                             uint64_t bytes, VkFormat texel, bool indirect) {
    if (old && old->sizeBytes() >= bytes) return old;
    gpu::retire(device_, std::move(old));
    return std::make_unique<gpu::Buffer>(
        device_,
        gpu::BufferDesc{
            .name = name, .sizeBytes = bytes + bytes / 2, .indirect = indirect, .texelFormat = texel});
}

void SceneGpu::reserveBuffers(const RenderScene& scene) {
    const uint64_t rowBytes = std::max<uint64_t>(scene.instances.size(), 1) * sizeof(io::Instance);
    const gpu::Buffer* before = instances_.get();
    instances_ = grown(std::move(instances_), "scene.instances", rowBytes, gpu::kVec4Texels, false);
    if (instances_.get() != before) instancesVersion_ = 0;
    previousInstances_ =
        grown(std::move(previousInstances_), "scene.previous_instances", rowBytes, gpu::kVec4Texels, false);
    reserveDraws(scene);
}

// Room for what all views draw; in a small scene for all that they ever may, so that it never grows.
void SceneGpu::reserveDraws(const RenderScene& scene) {
    constexpr uint64_t kAtOnce = 1u << 16;
    const uint64_t all =
        2 * uint64_t(viewSlots(scene).count) * scene.instances.size();  // ranges: powers of two
    const uint32_t least = uint32_t(std::clamp<uint64_t>(all, 64, kAtOnce));
    const uint64_t commandBytes =
        std::max(draws_.commandCapacity(), least) * sizeof(VkDrawIndexedIndirectCommand);
    const uint64_t rowBytes = std::max(draws_.rowCapacity(), least) * sizeof(uint32_t);
    const gpu::Buffer *commandsBefore = commands_.get(), *rowsBefore = drawnRows_.get();
    commands_ = grown(std::move(commands_), "scene.commands", commandBytes, VK_FORMAT_UNDEFINED, true);
    drawnRows_ = grown(std::move(drawnRows_), "scene.drawn_rows", rowBytes, VK_FORMAT_R32_UINT, false);
    if (commands_.get() != commandsBefore || drawnRows_.get() != rowsBefore) draws_.markAllDirty();
}

void SceneGpu::noteMovements(const RenderScene& scene) {
    if (notedVersion_ == scene.instancesVersion) return;
    bool moved = scene.allInstancesChanged || notedVersion_ + 1 != scene.instancesVersion;
    for (const RenderScene::Range& range : scene.changedInstances)
        for (uint32_t i = range.begin; i < range.end && !moved; ++i)
            moved = scene.instances[i].isPresent() && !scene.instances[i].movable;
    if (moved) ++staticVersion_;
    notedVersion_ = scene.instancesVersion;
}

ViewSlots viewSlots(const RenderScene& scene) {
    uint32_t rsms = 0, cascades = 0;
    for (const RenderLight& light : scene.lights) {
        if (light.bounces) rsms += gi::mostFacesOf(light.kind);
        if (light.kind == LightKind::kDirectional) cascades += io::kMaxCascades;
    }
    ViewSlots s{.camera = 0, .moved = 1, .everything = 2, .blended = 3, .firstRsm = 4};
    s.firstCascade = s.firstRsm + rsms;
    s.firstLight = s.firstCascade + cascades;
    s.count = s.firstLight + 6 * mostClustersNeeded(scene, kMostLightClusters);
    return s;
}

SceneView SceneGpu::import(GraphScope scope, const RenderScene& scene, const PixelGrid& grid,
                           std::optional<gi::TracedBy> traced, bool wholeMaterials) {
    AG_CHECK_MSG(positions_ && scene.geometry->version == geometryVersion_,
                 "load() the scene's geometry first");
    reserveBuffers(scene);
    points_.update(scene, wholeMaterials, lightUnit_);
    noteMovements(scene);
    SceneView view{.scene = &scene,
                   .draws = &draws_,
                   .slots = viewSlots(scene),
                   .grid = grid,
                   .eye = jittered(scene.camera, grid),
                   .hasEmissive = strongestEmission_ > 0,
                   .hasGlossy = hasGlossy_,
                   .leastRoughness = leastRoughness_,
                   .wholeMaterials = wholeMaterials && hasGlossy_,
                   .hasNormalMaps = hasNormalMaps_};
    view.skin = skin_.import(scope, scene, *positions_, *attributes_);
    view.loadedVersion = combineHash(geometryVersion_, loads_);
    view.geometry = {positions_.get(), attributes_.get(),           indices_.get(),
                     geometryVersion_, view.skin.deformedPositions, view.skin.deformedAttributes};
    // Constant versions: what a view draws of them is in its draws' versions.
    view.instances = scope.importBuffer("scene.instances", *instances_, 1);
    view.previousInstances = scope.importBuffer("scene.previous_instances", *previousInstances_, 1);
    const bool follows = !scene.allInstancesChanged && instancesVersion_ != 0 &&
                         instancesVersion_ + 1 == scene.instancesVersion;
    if (follows && scene.replacedInstances.empty())
        view.moved = scene.changedInstances;
    else if (follows)
        view.moved = stillThere(scene, moved_);
    view.replaced = !follows || !scene.replacedInstances.empty();
    view.commands = scope.importBuffer("scene.commands", *commands_, 1);
    view.drawnRows = scope.importBuffer("scene.drawn_rows", *drawnRows_, 1);
    view.materials = scope.importBuffer("scene.materials", *materials_, materialsVersion_);
    static constexpr std::array kSrgbNames = {"scene.srgb256", "scene.srgb512", "scene.srgb1024",
                                              "scene.srgb2048"};
    static constexpr std::array kLinearNames = {"scene.linear256", "scene.linear512", "scene.linear1024",
                                                "scene.linear2048"};
    for (size_t c = 0; c < 4; ++c) {
        view.srgbTextures[c] = scope.importImage(kSrgbNames[c], *srgb_[c], geometryVersion_);
        view.linearTextures[c] = scope.importImage(kLinearNames[c], *linear_[c], geometryVersion_);
    }
    points_.import(scope, view.points);
    view.staticVersion =
        combineHash(combineHash(points_.staticVersion(), staticVersion_), scene.originVersion);
    if (traced)
        view.trees = trees_.import(scope, scene, combineHash(view.staticVersion, scene.originVersion),
                                   *traced, {wholeMaterials, lightUnit_});
    view.sky = sky_.import(scope, scene.sky, lightUnit_, view.skyPicture);
    view.camera = gi::addCamera(scope, "scene.camera", view.eye, grid.size);
    return view;
}

void SceneGpu::stage(VkCommandBuffer commands, uint32_t frameSlot, std::span<const std::byte> bytes,
                     const gpu::Buffer& to, uint64_t offset) {
    if (bytes.empty()) return;
    Staging& staging = staging_[frameSlot];
    if (!staging.buffer || staging.used + bytes.size() > staging.buffer->sizeBytes()) {
        gpu::retire(device_, std::move(staging.buffer));
        const uint64_t size = std::max<uint64_t>(uint64_t(1) << 20, bytes.size() * 2);
        staging.buffer = std::make_unique<gpu::Buffer>(
            device_, gpu::BufferDesc{.name = "scene.staging", .sizeBytes = size, .hostVisible = true});
        staging.used = 0;
    }
    std::memcpy(staging.buffer->mapped() + staging.used, bytes.data(), bytes.size());
    if (uploadedBytes_ == 0) transferBarrier(device_.vk(), commands, Transfer::kBefore);
    const VkBufferCopy region{.srcOffset = staging.used, .dstOffset = offset, .size = bytes.size()};
    device_.vk().CmdCopyBuffer(commands, staging.buffer->handle(), to.handle(), 1, &region);
    staging.used += bytes.size();
    uploadedBytes_ += bytes.size();
}

// On the device, before new rows take their place.
void SceneGpu::keepPrevious(VkCommandBuffer commands, const SceneView& view) {
    std::vector<VkBufferCopy> regions;
    for (const RenderScene::Range& range : view.moved) {
        const uint64_t offset = range.begin * sizeof(io::Instance);
        regions.push_back({offset, offset, (range.end - range.begin) * sizeof(io::Instance)});
        uploadedBytes_ += regions.back().size;
    }
    if (regions.empty()) return;
    transferBarrier(device_.vk(), commands, Transfer::kBefore);
    device_.vk().CmdCopyBuffer(commands, instances_->handle(), previousInstances_->handle(),
                               uint32_t(regions.size()), regions.data());
    if (view.skin) {
        const std::vector<VkBufferCopy> joints = skin_.copiesToPrevious(*view.scene, view.moved);
        if (!joints.empty())
            device_.vk().CmdCopyBuffer(commands, skin_.joints().handle(), skin_.previousJoints().handle(),
                                       uint32_t(joints.size()), joints.data());
    }
    transferBarrier(device_.vk(), commands, Transfer::kBetweenCopies);
}

void SceneGpu::uploadInstances(VkCommandBuffer commands, const RenderScene& scene, uint32_t frameSlot) {
    if (instancesVersion_ == scene.instancesVersion) return;
    const bool all = scene.allInstancesChanged || instancesVersion_ + 1 != scene.instancesVersion;
    const auto send = [&](uint32_t begin, uint32_t end) {
        rows_.clear();
        for (uint32_t i = begin; i < end; ++i)
            rows_.push_back(instanceRow(scene.instances[i], *scene.geometry));
        stage(commands, frameSlot, std::as_bytes(std::span(rows_)), *instances_,
              begin * sizeof(io::Instance));
    };
    if (all)
        send(0, uint32_t(scene.instances.size()));
    else
        for (const RenderScene::Range& range : scene.changedInstances)
            send(range.begin, range.end);
    instancesVersion_ = scene.instancesVersion;
}

void SceneGpu::uploadDraws(VkCommandBuffer commands, const ViewDraws& draws, uint32_t frameSlot) {
    viewCommands_.assign(draws.commands.begin(), draws.commands.end());
    for (VkDrawIndexedIndirectCommand& command : viewCommands_)
        command.firstInstance += draws.rowRange.first;
    stage(commands, frameSlot, std::as_bytes(std::span(viewCommands_)), *commands_,
          draws.commandRange.first * sizeof(VkDrawIndexedIndirectCommand));
    stage(commands, frameSlot, std::as_bytes(std::span(draws.rows)), *drawnRows_,
          draws.rowRange.first * sizeof(uint32_t));
}

void SceneGpu::upload(VkCommandBuffer commands, FrameGraph& graph, const SceneView& view, Previous previous,
                      uint32_t frameSlot) {
    const RenderScene& scene = *view.scene;
    uploadedBytes_ = 0;
    staging_[frameSlot].used = 0;
    if (previous == Previous::kKept) keepPrevious(commands, view);
    uploadInstances(commands, scene, frameSlot);
    const auto send = [&](std::span<const std::byte> bytes, const gpu::Buffer& to, uint64_t offset) {
        stage(commands, frameSlot, bytes, to, offset);
    };
    if (view.skin) skin_.upload(scene, send);
    if (view.trees) trees_.upload(send);
    points_.upload(send);
    reserveDraws(scene);
    graph.rebind(view.commands, *commands_);
    graph.rebind(view.drawnRows, *drawnRows_);
    for (uint32_t slot = 0; slot < draws_.viewCount(); ++slot)
        if (draws_.takeDirty(slot)) uploadDraws(commands, draws_.draws(slot), frameSlot);
    if (uploadedBytes_ > 0) transferBarrier(device_.vk(), commands, Transfer::kAfter);
}

uint64_t SceneGpu::deviceBytes() const {
    uint64_t bytes = 0;
    for (const auto* buffer : {positions_.get(), attributes_.get(), indices_.get(), materials_.get(),
                               instances_.get(), previousInstances_.get(), commands_.get(), drawnRows_.get()})
        if (buffer) bytes += buffer->sizeBytes();
    return bytes + skin_.deviceBytes() + points_.deviceBytes() + trees_.deviceBytes() + sky_.deviceBytes();
}

}  // namespace ag::render
