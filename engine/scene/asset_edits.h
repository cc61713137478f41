// What someone changed of a scene after it was loaded: where nodes stand and how materials look.
#pragma once

#include <vector>

#include "engine/core/result.h"
#include "engine/scene/scene_asset.h"

namespace ag {

struct NodeMove {
    uint32_t node = 0;
    glm::dvec3 offset{0};  // m, in the world, from where it was loaded

    bool operator==(const NodeMove&) const = default;
};

// The factors of a material, whose textures stay.
struct MaterialLook {
    uint32_t material = 0;
    glm::vec4 baseColor{1};
    float metallic = 1, roughness = 1;
    glm::vec3 emissive{0};  // W/(m² sr)

    bool operator==(const MaterialLook&) const = default;
};

struct AssetEdits {
    std::vector<NodeMove> moves;      // one a node
    std::vector<MaterialLook> looks;  // one a material

    bool empty() const { return moves.empty() && looks.empty(); }
    bool operator==(const AssetEdits&) const = default;
};

MaterialLook lookOf(const GeometryArrays& geometry, uint32_t material);
void setLook(const MaterialLook& look, Material& material);
// The node moved by so much in the world, as its parent sees it; what is below it comes along. Nothing where
// its parent is flat.
glm::dvec3 offsetInParent(const SceneAsset& asset, const NodeMove& move);
// Fails where there is no such node or material.
Status applyEdits(const AssetEdits& edits, SceneAsset& asset);

}  // namespace ag
