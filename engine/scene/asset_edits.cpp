#include "engine/scene/asset_edits.h"

#include <fmt/format.h>

#include <cmath>

#include "engine/scene/static_scene.h"

namespace ag {

MaterialLook lookOf(const GeometryArrays& geometry, uint32_t material) {
    const Material& m = geometry.materials[material];
    return {material, m.baseColor, m.metallic, m.roughness, m.emissive};
}

void setLook(const MaterialLook& look, Material& material) {
    material.baseColor = look.baseColor;
    material.metallic = look.metallic;
    material.roughness = look.roughness;
    material.emissive = look.emissive;
}

glm::dvec3 offsetInParent(const SceneAsset& asset, const NodeMove& move) {
    const int32_t parent = asset.nodes[move.node].parent;
    if (parent < 0) return move.offset;
    const glm::dmat3 linear(placeNodes(asset)[size_t(parent)].linear);
    const double volume = glm::determinant(linear);
    return volume == 0 || !std::isfinite(1 / volume) ? glm::dvec3(0) : glm::inverse(linear) * move.offset;
}

Status applyEdits(const AssetEdits& edits, SceneAsset& asset) {
    for (const NodeMove& move : edits.moves) {
        if (move.node >= asset.nodes.size())
            return Error{fmt::format("{} has no node {} to move", asset.name, move.node)};
        asset.nodes[move.node].local.translation += offsetInParent(asset, move);
    }
    for (const MaterialLook& look : edits.looks) {
        if (look.material >= asset.geometry.materials.size())
            return Error{fmt::format("{} has no material {} to change", asset.name, look.material)};
        setLook(look, asset.geometry.materials[look.material]);
    }
    return Ok{};
}

}  // namespace ag
