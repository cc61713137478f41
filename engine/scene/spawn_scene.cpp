#include "engine/scene/spawn_scene.h"

#include <algorithm>
#include <cmath>

#include "engine/scene/components.h"
#include "engine/scene/mover.h"
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

}  // namespace

std::vector<Entity> spawnScene(World& world, const SceneAsset& asset) {
    std::vector<Entity> entities;
    uint32_t deepest = 0;
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
        if (node.mesh >= 0) {
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
    for (size_t node : strongestLights(asset))
        world.add(entities[node], BounceLight{});
    world.setResource<HierarchyLevels>(deepest);
    return entities;
}

}  // namespace ag
