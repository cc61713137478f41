#include "engine/renderer/scene_trees.h"

#include <algorithm>
#include <cmath>

#include "engine/core/hash.h"
#include "engine/gpu/transfer.h"

namespace ag::render {
namespace {

constexpr VkFormat kWords = VK_FORMAT_R32G32B32A32_UINT;

// What trees are built of: where static things stand and, if they are of all, the meshes of those that move,
// however many have them.
uint64_t builtFrom(const RenderScene& scene, gi::TreesOf of, std::vector<bool>& moving) {
    uint64_t hash = combineHash(scene.geometry->version, uint64_t(of));
    moving.assign(scene.geometry->primitives.size(), false);
    for (const RenderInstance& instance : scene.instances)
        if (!instance.isPresent())
            continue;
        else if (instance.movable || instance.skinnedMesh != kNoSkinnedMesh)
            moving[instance.primitive] = true;
        else
            hash = combineHash(combineHash(hash, instance.primitive), hashValue(instance.worldFromLocal));
    return of == gi::TreesOf::kStatic ? hash : combineHash(hash, std::hash<std::vector<bool>>{}(moving));
}

// Whether something moves whose mesh has no tree yet.
bool movesAnew(const RenderScene& scene, const std::vector<bool>& moving) {
    if (scene.replacedInstances.empty()) return false;
    return std::ranges::any_of(scene.instances, [&](const RenderInstance& instance) {
        return instance.isPresent() && instance.movable && !moving[instance.primitive];
    });
}

template <class T>
std::unique_ptr<gpu::Buffer> roomFor(gpu::Device& device, std::unique_ptr<gpu::Buffer> old, const char* name,
                                     const std::vector<T>& items) {
    const uint64_t bytes = std::max<uint64_t>(items.size(), 1) * sizeof(T);
    if (old && old->sizeBytes() >= bytes) return old;
    gpu::retire(device, std::move(old));
    return std::make_unique<gpu::Buffer>(
        device,
        gpu::BufferDesc{
            .name = name, .sizeBytes = bytes + bytes / 2 / sizeof(T) * sizeof(T), .texelFormat = kWords});
}

}  // namespace

void SceneTrees::build(const RenderScene& scene) {
    trees_ = buildTrees(scene, of_, sent_);
    gpu::retire(device_, std::move(nodes_));
    gpu::retire(device_, std::move(triangles_));
    gpu::retire(device_, std::move(masks_));
    nodes_ = gpu::loadBuffer(device_, {.name = "scene.tree_nodes", .texelFormat = kWords}, trees_.nodes);
    triangles_ = gpu::loadBuffer(device_, {.name = "scene.tree_triangles"}, trees_.triangles);
    if (!trees_.masks.empty()) masks_ = gpu::loadBuffer(device_, {.name = "scene.tree_masks"}, trees_.masks);
    trees_.nodes = {};  // the device has them
    trees_.triangles = {};
    trees_.masks = {};
    ++builds_;
}

void SceneTrees::place(const RenderScene& scene) {
    placeTrees(scene, trees_, of_ == gi::TreesOf::kAll, moving_, movers_);
    places_ = roomFor(device_, std::move(places_), "scene.tree_places", movers_.places);
    moverNodes_ = roomFor(device_, std::move(moverNodes_), "scene.mover_nodes", movers_.nodes);
    uploaded_ = false;
    ++placings_;
}

// Whether the trees are those of what is static now.
bool SceneTrees::follow(const RenderScene& scene, uint64_t staticVersion, gi::TreesOf of, SurfaceLight sent) {
    if (of_ != of || sent_ != sent) forget();  // built at once
    of_ = of;
    sent_ = sent;
    if (staticVersion_ != staticVersion || (of == gi::TreesOf::kAll && movesAnew(scene, movingPrimitives_)))
        from_ = builtFrom(scene, of, movingPrimitives_);
    staticVersion_ = staticVersion;
    const gi::TreeUpkeep::Task task = upkeep_.next(from_);
    if (task == gi::TreeUpkeep::Task::kBuild) {
        build(scene);
        placedOf_ = 0;
    }
    return task != gi::TreeUpkeep::Task::kNone;
}

gi::TracedOccluders SceneTrees::import(GraphScope scope, const RenderScene& scene, uint64_t staticVersion,
                                       gi::TracedBy by, SurfaceLight sent) {
    const bool follows = follow(scene, staticVersion, by.of, sent);
    if (!nodes_) return {};
    const bool moves = scene.instancesVersion != before_, waits = by.atRest && moves && placedOf_ != 0;
    before_ = scene.instancesVersion;
    const uint64_t placing = by.of == gi::TreesOf::kAll ? scene.instancesVersion : 1;
    if (follows && !waits) {
        if (placedOf_ != placing) place(scene);
        placedOf_ = placing;
    }
    return {.nodes = scope.importBuffer("scene.tree_nodes", *nodes_, builds_),
            .triangles = scope.importBuffer("scene.tree_triangles", *triangles_, builds_),
            .masks = masks_ ? scope.importBuffer("scene.tree_masks", *masks_, builds_) : BufferHandle{},
            .places = scope.importBuffer("scene.tree_places", *places_, placings_),
            .moverNodes = scope.importBuffer("scene.mover_nodes", *moverNodes_, placings_),
            .staticVersion = builds_,
            .snapping = std::exp2(-float(device_.info().limits.subPixelPrecisionBits)),
            .stale = !follows};
}

void SceneTrees::upload(Stage stage) {
    if (uploaded_) return;
    uploaded_ = true;
    stage(std::as_bytes(std::span(movers_.places)), *places_, 0);
    stage(std::as_bytes(std::span(movers_.nodes)), *moverNodes_, 0);
}

uint64_t SceneTrees::deviceBytes() const {
    uint64_t bytes = 0;
    for (const auto* buffer :
         {nodes_.get(), triangles_.get(), masks_.get(), places_.get(), moverNodes_.get()})
        if (buffer) bytes += buffer->sizeBytes();
    return bytes;
}

}  // namespace ag::render
