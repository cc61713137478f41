#include "engine/scene/spawn_scene.h"

#include <algorithm>
#include <cmath>

#include "engine/scene/components.h"
#include "engine/scene/mover.h"
#include "engine/scene/skinned_mesh.h"
#include "engine/scene/transform_system.h"

namespace ag {
namespace {

constexpr size_t kMostBounceLights = 8;

// Nodes of the strongest lights; suns before lamps.
std::vector<size_t> strongestLights(const SceneAsset& asset) {
    std::vector<size_t> nodes;
    for (size_t i = 0; i < asset.nodes.size(); ++i)
        if (asset.nodes[i].light >= 0 && asset.nodes[i].extras.bounces) nodes.push_back(i);
    const auto strength = [&](size_t node) {
        const SceneLight& l = asset.lights[size_t(asset.nodes[node].light)];
        const float mean = (l.intensity.x + l.intensity.y + l.intensity.z) / 3;
        return std::pair(l.kind == LightKind::kDirectional, mean);
    };
    std::ranges::stable_sort(nodes, [&](size_t a, size_t b) { return strength(a) > strength(b); });
    nodes.resize(std::min(nodes.size(), kMostBounceLights));
    return nodes;
}

void addMover(World& world, const SceneNode& node, Entity entity) {
    const NodeExtras& extras = node.extras;
    if (extras.movePeriod <= 0 && extras.spinSpeed == 0) return;
    world.add(entity, Mover{node.local.translation, extras.moveExtent, extras.movePeriod, extras.spinSpeed,
                            2 * std::atan2(node.local.rotation.y, node.local.rotation.w)});
    if (MeshInstance* mesh = world.write<MeshInstance>(entity)) mesh->movable = 1;
}

AnimationPlayer playerOf(const NodeExtras& extras) {
    return {extras.clip, extras.clipStart, extras.clipSpeed, extras.clipLoops};
}

// A skinned mesh stands in the frame its joints hang from, whatever node shows it: it is an entity of its
// own. Returns its depth.
uint32_t addSkinnedMesh(World& world, const SceneAsset& asset, const SkinnedMeshLibrary& library, size_t node,
                        std::vector<Entity>& entities) {
    const auto model = uint32_t(library.modelOfNode[node]);
    const SceneMesh& mesh = asset.meshes[library.models[model].mesh];
    const Entity entity = world.create(LocalTransform{.node = uint32_t(node)}, WorldTransform{},
                                       makeName(asset.nodes[node].name),
                                       MeshInstance{mesh.firstPrimitive, mesh.primitiveCount, 1},
                                       SkinnedMesh{model}, playerOf(asset.nodes[node].extras));
    entities.push_back(entity);
    const int32_t frame = library.models[model].frame;
    if (frame < 0) return 0;
    const uint32_t depth = asset.nodes[size_t(frame)].depth + 1;
    world.add(entity, Parent{entities[size_t(frame)]});
    world.add(entity, HierarchyDepth{depth});
    return depth;
}

// Nodes that an animation moves and from which something hangs that is seen. Joints alone are not seen:
// skinned meshes know where they are.
std::vector<size_t> movingNodes(const SceneAsset& asset, const SkinnedMeshLibrary& library) {
    std::vector<bool> seen(asset.nodes.size(), false);
    for (const SkinnedModel& model : library.models)
        if (model.frame >= 0) seen[size_t(model.frame)] = true;
    for (size_t i = asset.nodes.size(); i-- > 0;) {
        const SceneNode& n = asset.nodes[i];
        if ((n.mesh >= 0 && library.modelOfNode[i] < 0) || n.light >= 0 || n.camera >= 0) seen[i] = true;
        if (seen[i] && n.parent >= 0) seen[size_t(n.parent)] = true;
    }
    std::vector<bool> moves(asset.nodes.size(), false);
    for (const SceneAnimation& animation : asset.animations)
        for (const SceneChannel& channel : animation.channels)
            moves[channel.node] = true;
    std::vector<size_t> nodes;
    for (size_t i = 0; i < asset.nodes.size(); ++i)
        if (seen[i] && moves[i]) nodes.push_back(i);
    return nodes;
}

// They and what hangs from them is movable.
void addPlayers(World& world, const SceneAsset& asset, const SkinnedMeshLibrary& library,
                const std::vector<Entity>& entities) {
    std::vector<bool> moved(asset.nodes.size(), false);
    for (const size_t node : movingNodes(asset, library)) {
        world.add(entities[node], playerOf(asset.nodes[node].extras));
        moved[node] = true;
    }
    for (size_t i = 0; i < asset.nodes.size(); ++i) {
        const int32_t parent = asset.nodes[i].parent;
        moved[i] = moved[i] || (parent >= 0 && moved[size_t(parent)]);
        if (!moved[i]) continue;
        if (MeshInstance* mesh = world.write<MeshInstance>(entities[i])) mesh->movable = 1;
    }
}

}  // namespace

std::vector<Entity> spawnScene(World& world, const SceneAsset& asset) {
    std::vector<Entity> entities;
    uint32_t deepest = 0;
    const SkinnedMeshLibrary& library = world.setResource<SkinnedMeshLibrary>(makeSkinnedMeshLibrary(asset));
    for (size_t i = 0; i < asset.nodes.size(); ++i) {
        const SceneNode& node = asset.nodes[i];
        const LocalTransform local{node.local.translation, node.local.rotation, node.local.scale,
                                   uint32_t(i)};
        const Entity entity = world.create(local, WorldTransform{}, makeName(node.name));
        entities.push_back(entity);
        deepest = std::max(deepest, node.depth);
        if (node.parent >= 0) {
            world.add(entity, Parent{entities[size_t(node.parent)]});
            world.add(entity, HierarchyDepth{node.depth});
        }
        if (node.mesh >= 0 && library.modelOfNode[i] < 0) {
            const SceneMesh& mesh = asset.meshes[size_t(node.mesh)];
            world.add(entity, MeshInstance{mesh.firstPrimitive, mesh.primitiveCount});
        }
        if (node.light >= 0) {
            const SceneLight& l = asset.lights[size_t(node.light)];
            world.add(entity, PunctualLight{l.intensity, l.range, l.innerConeAngle, l.outerConeAngle, l.kind,
                                            node.extras.castsShadow});
        }
    }
    for (size_t i = 0; i < asset.nodes.size(); ++i)
        addMover(world, asset.nodes[i], entities[i]);
    for (size_t i = 0; i < asset.nodes.size(); ++i)
        if (library.modelOfNode[i] >= 0)
            deepest = std::max(deepest, addSkinnedMesh(world, asset, library, i, entities));
    addPlayers(world, asset, library, entities);
    for (size_t node : strongestLights(asset))
        world.add(entities[node], BounceLight{});
    world.setResource<HierarchyLevels>(deepest);
    return entities;
}

}  // namespace ag
