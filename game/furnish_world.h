// From the level's tags to components: what a node is in the game stands in its glTF extras.
#pragma once

#include <vector>

#include "engine/ecs/world.h"
#include "engine/scene/scene_asset.h"
#include "game/components.h"

namespace ag::game {

// `entities`: of the asset's nodes, as spawnScene made them. Returns the level's hints.
std::vector<Hint> furnishWorld(World& world, const SceneAsset& asset, const std::vector<Entity>& entities);

}  // namespace ag::game
