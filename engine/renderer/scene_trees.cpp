#include "engine/renderer/scene_trees.h"

#include <algorithm>

#include "engine/core/hash.h"
#include "engine/gpu/transfer.h"
#include "engine/renderer/scene_surfaces.h"

namespace ag::render {
namespace {

constexpr VkFormat kNodes = VK_FORMAT_R32G32B32A32_UINT, kVec4 = VK_FORMAT_R32G32B32A32_SFLOAT;

// What trees are built of: where static things stand, and the meshes of those that move.
uint64_t builtFrom(const RenderScene& scene) {
    uint64_t hash = scene.geometry->version;
    for (const RenderInstance& instance : scene.instances) {
        hash = combineHash(hash, instance.primitive * 2 + instance.movable);
        if (!instance.movable) hash = combineHash(hash, hashValue(instance.worldFromLocal));
    }
    return hash;
}

template <class T>
std::unique_ptr<gpu::Buffer> roomFor(gpu::Device& device, std::unique_ptr<gpu::Buffer> old, const char* name,
                                     const std::vector<T>& items, VkFormat format) {
    const uint64_t bytes = std::max<uint64_t>(items.size(), 1) * sizeof(T);
    if (old && old->sizeBytes() >= bytes) return old;
    gpu::retire(device, std::move(old));
    return std::make_unique<gpu::Buffer>(
        device,
        gpu::BufferDesc{
            .name = name, .sizeBytes = bytes + bytes / 2 / sizeof(T) * sizeof(T), .texelFormat = format});
}

}  // namespace

void SceneTrees::build(const RenderScene& scene) {
    trees_ = buildTrees(scene);
    gpu::retire(device_, std::move(nodes_));
    gpu::retire(device_, std::move(triangles_));
    nodes_ = gpu::loadBuffer(device_, {.name = "scene.tree_nodes", .texelFormat = kNodes}, trees_.nodes);
    triangles_ =
        gpu::loadBuffer(device_, {.name = "scene.tree_triangles", .texelFormat = kVec4}, trees_.triangles);
    trees_.nodes = {};  // the device has them
    trees_.triangles = {};
    placedOf_ = 0;
}

void SceneTrees::place(const RenderScene& scene) {
    movers_ = placeTrees(scene, trees_);
    places_ = roomFor(device_, std::move(places_), "scene.tree_places", movers_.places, kVec4);
    moverNodes_ = roomFor(device_, std::move(moverNodes_), "scene.mover_nodes", movers_.nodes, kNodes);
    uploaded_ = false;
}

gi::TracedOccluders SceneTrees::import(GraphScope scope, const RenderScene& scene) {
    if (checkedOf_ != scene.instancesVersion) {
        checkedOf_ = scene.instancesVersion;
        const uint64_t from = builtFrom(scene);
        if (builtOf_ != from) build(scene);
        builtOf_ = from;
    }
    if (placedOf_ != scene.instancesVersion) place(scene);
    placedOf_ = scene.instancesVersion;
    return {.nodes = scope.importBuffer("scene.tree_nodes", *nodes_, builtOf_ | 1),
            .triangles = scope.importBuffer("scene.tree_triangles", *triangles_, builtOf_ | 1),
            .places = scope.importBuffer("scene.tree_places", *places_, placedOf_ | 1),
            .moverNodes = scope.importBuffer("scene.mover_nodes", *moverNodes_, placedOf_ | 1)};
}

void SceneTrees::upload(Stage stage) {
    if (uploaded_) return;
    uploaded_ = true;
    stage(std::as_bytes(std::span(movers_.places)), *places_, 0);
    stage(std::as_bytes(std::span(movers_.nodes)), *moverNodes_, 0);
}

uint64_t SceneTrees::deviceBytes() const {
    uint64_t bytes = 0;
    for (const auto* buffer : {nodes_.get(), triangles_.get(), places_.get(), moverNodes_.get()})
        if (buffer) bytes += buffer->sizeBytes();
    return bytes;
}

}  // namespace ag::render
