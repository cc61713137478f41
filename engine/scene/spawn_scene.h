// An asset's nodes as entities.
#pragma once

#include "engine/ecs/world.h"
#include "engine/scene/scene_asset.h"

namespace ag {

// Entities parallel to the asset's nodes. Sets the resource HierarchyLevels. The eight strongest lights
// bounce.
std::vector<Entity> spawnScene(World& world, const SceneAsset& asset);

}  // namespace ag
