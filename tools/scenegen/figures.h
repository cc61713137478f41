// Skinned meshes made in code: pillars that bend over a chain of joints.
#pragma once

#include "engine/scene/scene_asset.h"
#include "tools/scenegen/shapes.h"

namespace ag::scenegen {

struct PillarShape {
    float height = 1.6f, radius = 0.14f;  // m
    uint32_t joints = 5, rings = 20, sides = 14;
};

MeshParts pillarParts(const PillarShape& shape, uint32_t body, uint32_t cap);  // materials

// Gives the nodes of `asset` that show `mesh` a skin each: a chain of joints under the node's parent, one
// above the other; the mesh is bent over them by its height. One animation of `seconds` sways all.
void addChains(SceneAsset& asset, uint32_t mesh, const PillarShape& shape, float seconds);

// `param` swaying pillars (default 16) on a floor among three coloured walls, under a spot.
SceneAsset figures(uint32_t param);

}  // namespace ag::scenegen
