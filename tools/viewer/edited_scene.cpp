#include "tools/viewer/edited_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "engine/scene/static_scene.h"

namespace ag::viewer {
namespace {

glm::dvec3 offsetOf(const AssetEdits& edits, uint32_t node) {
    const auto found = std::ranges::find(edits.moves, node, &NodeMove::node);
    return found == edits.moves.end() ? glm::dvec3(0) : found->offset;
}

// From one to the other.
std::vector<NodeMove> movesBetween(const AssetEdits& from, const AssetEdits& to) {
    std::vector<NodeMove> moves;
    for (const AssetEdits* edits : {&from, &to})
        for (const NodeMove& m : edits->moves) {
            const glm::dvec3 by = offsetOf(to, m.node) - offsetOf(from, m.node);
            if (by != glm::dvec3(0) && std::ranges::count(moves, m.node, &NodeMove::node) == 0)
                moves.push_back({m.node, by});
        }
    return moves;
}

}  // namespace

EditedScene::EditedScene(SceneAsset& asset, RenderScene& scene, AssetEdits loaded)
    : asset_(asset), scene_(scene), applied_(std::move(loaded)), nodes_(placingNodes(asset)) {
    for (uint32_t m = 0; m < asset.geometry.materials.size(); ++m)
        start_.push_back(lookOf(asset.geometry, m));
    fromFile_ = std::ranges::any_of(asset.nodes, [](const SceneNode& n) { return n.source >= 0; });
}

std::optional<uint32_t> EditedScene::thingOf(uint32_t instance) const {
    int32_t node = nodes_[instance];
    while (fromFile_ && node >= 0 && asset_.nodes[size_t(node)].source < 0)
        node = asset_.nodes[size_t(node)].parent;
    return node < 0 ? std::nullopt : std::optional(uint32_t(node));
}

std::string EditedScene::nameOf(uint32_t node) const {
    const std::string& name = asset_.nodes[node].name;
    return name.empty() ? fmt::format("node {}", node) : name;
}

bool EditedScene::isBelow(int32_t node, uint32_t ancestor) const {
    while (node > int32_t(ancestor))  // parents come first
        node = asset_.nodes[size_t(node)].parent;
    return node == int32_t(ancestor);
}

Bounds EditedScene::boundsOf(uint32_t node) const {
    Bounds bounds;
    for (size_t i = 0; i < nodes_.size(); ++i)
        if (isBelow(nodes_[i], node)) bounds.add(worldBounds(scene_, scene_.instances[i]));
    return bounds;
}

// What moves from now on is no longer among what is still, whose maps and points last.
void EditedScene::moveRows(const NodeMove& by) {
    bool wereStill = false;
    for (uint32_t i = 0; i < nodes_.size(); ++i) {
        if (!isBelow(nodes_[i], by.node)) continue;
        RenderInstance& row = scene_.instances[i];
        wereStill |= !std::exchange(row.movable, true);
        row.worldFromLocal[3] = glm::vec3(glm::dvec3(row.worldFromLocal[3]) + by.offset);
        scene_.changedInstances.push_back({i, i + 1});
    }
    scene_.allInstancesChanged |= wereStill;
}

// Those that stand where the thing's nodes have lights.
bool EditedScene::moveLights(const NodeMove& by) {
    const std::vector<WorldPlacement> places = placeNodes(asset_);
    std::vector<bool> moved(scene_.lights.size());  // a lamp may come to stand where the next one stood
    for (size_t n = by.node; n < asset_.nodes.size(); ++n) {
        if (asset_.nodes[n].light < 0 || !isBelow(int32_t(n), by.node)) continue;
        const glm::vec3 at(places[n].translation - scene_.originWorld);
        for (size_t l = 0; l < scene_.lights.size(); ++l) {
            RenderLight& light = scene_.lights[l];
            if (moved[l] || light.kind == LightKind::kDirectional || light.position != at) continue;
            light.position = glm::vec3(places[n].translation + by.offset - scene_.originWorld);
            moved[l] = true;
        }
    }
    return std::ranges::count(moved, true) > 0;
}

bool EditedScene::move(const NodeMove& by) {
    const bool lights = moveLights(by);
    moveRows(by);
    asset_.nodes[by.node].local.translation += offsetInParent(asset_, by);
    return lights;
}

bool EditedScene::setLooks(const AssetEdits& wanted) {
    bool changed = false;
    for (const MaterialLook& start : start_) {
        const auto edited = std::ranges::find(wanted.looks, start.material, &MaterialLook::material);
        const MaterialLook& look = edited == wanted.looks.end() ? start : *edited;
        if (lookOf(asset_.geometry, start.material) == look) continue;
        setLook(look, asset_.geometry.materials[start.material]);
        changed = true;
    }
    asset_.geometry.version += changed;
    return changed;
}

EditedScene::Changes EditedScene::follow(const AssetEdits& wanted) {
    if (wanted == applied_) return {};
    const std::vector<NodeMove> moves = movesBetween(applied_, wanted);
    Changes changes;
    if (!moves.empty()) {
        scene_.changedInstances.clear();
        ++scene_.instancesVersion;
    }
    for (const NodeMove& by : moves)
        changes.lights |= move(by);
    if (!moves.empty()) {
        scene_.bounds = {};
        for (const RenderInstance& instance : scene_.instances)
            scene_.bounds.add(worldBounds(scene_, instance));
    }
    scene_.lightsVersion += changes.lights;
    changes.materials = setLooks(wanted);
    applied_ = wanted;
    return changes;
}

void EditedScene::rendered() {
    scene_.changedInstances.clear();
    scene_.allInstancesChanged = false;
}

}  // namespace ag::viewer
