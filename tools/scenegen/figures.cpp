#include "tools/scenegen/figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "common/sampling.h"
#include "engine/scene/mover.h"
#include "tools/scenegen/builder.h"

namespace ag::scenegen {
namespace {

constexpr uint32_t kKeys = 12;  // of a turn of the animation

// Each vertex belongs to the two joints it stands between.
SkinVertex skinAt(float height, const PillarShape& shape) {
    const float length = shape.height / float(shape.joints);
    const float at = std::clamp(height / length - 0.5f, 0.0f, float(shape.joints - 1));
    const auto lower = uint32_t(at), upper = std::min(lower + 1, shape.joints - 1);
    const float share = at - float(lower);
    return {.joints = {uint16_t(lower), uint16_t(upper), 0, 0}, .weights = {1 - share, share, 0, 0}};
}

void weighVertices(SceneAsset& asset, uint32_t mesh, const PillarShape& shape) {
    GeometryArrays& g = asset.geometry;
    g.skin.resize(g.positions.size());
    const SceneMesh& m = asset.meshes[mesh];
    for (uint32_t i = m.firstPrimitive; i < m.firstPrimitive + m.primitiveCount; ++i) {
        const Primitive& p = g.primitives[i];
        const auto indices = std::span(g.indices).subspan(p.firstIndex, p.indexCount);
        for (uint32_t v = 0; v <= std::ranges::max(indices); ++v)
            g.skin[size_t(p.vertexOffset) + v] = skinAt(g.positions[size_t(p.vertexOffset) + v].y, shape);
    }
}

// To and fro about an axis that turns slowly up the chain: no two joints bend alike.
SceneChannel swayOf(uint32_t node, uint32_t joint, float seconds) {
    SceneChannel channel{.node = node, .path = ChannelPath::kRotation};
    for (uint32_t k = 0; k <= kKeys; ++k) {
        const double turn = double(k) / kKeys;
        const float angle = (0.12f + 0.08f * float(joint)) * sineOfTurns(turn + 0.12 * joint);
        const glm::vec3 axis(sineOfTurns(0.25 + 0.1 * joint), 0, sineOfTurns(0.1 * joint));
        const glm::quat q = glm::angleAxis(angle, glm::normalize(axis));
        channel.times.push_back(seconds * float(turn));
        channel.values.emplace_back(q.x, q.y, q.z, q.w);
    }
    return channel;
}

uint32_t addChain(SceneAsset& asset, uint32_t figure, const PillarShape& shape, float seconds) {
    SceneSkin skin{.name = asset.nodes[figure].name};
    const float length = shape.height / float(shape.joints);
    int32_t parent = asset.nodes[figure].parent;
    for (uint32_t j = 0; j < shape.joints; ++j) {
        const auto node = uint32_t(asset.nodes.size());
        asset.nodes.push_back({.name = fmt::format("{} joint {}", asset.nodes[figure].name, j),
                               .parent = parent,
                               .depth = parent < 0 ? 0 : asset.nodes[size_t(parent)].depth + 1,
                               .local = {.translation = {0, j ? length : 0, 0}}});
        skin.joints.push_back(node);
        glm::mat4 inverseBind(1);
        inverseBind[3].y = -length * float(j);
        skin.inverseBind.push_back(inverseBind);
        asset.animations[0].channels.push_back(swayOf(node, j, seconds));
        parent = int32_t(node);
    }
    asset.skins.push_back(std::move(skin));
    return uint32_t(asset.skins.size() - 1);
}

}  // namespace

MeshParts pillarParts(const PillarShape& shape, uint32_t body, uint32_t cap) {
    MeshParts parts;
    std::vector<glm::vec2> profile;
    for (uint32_t r = 0; r <= shape.rings; ++r) {
        const float t = float(r) / float(shape.rings);
        const float swell = 1 + 0.18f * std::sin(9.42f * t) - 0.3f * t;
        profile.emplace_back(shape.radius * swell, shape.height * t);
    }
    addLathe(parts, body, profile, shape.sides, glm::vec3(0));
    const glm::vec2 rim = profile.back();
    const glm::vec2 dome[] = {rim, {rim.x * 0.8f, rim.y + rim.x * 0.6f}, {0, rim.y + rim.x}};
    addLathe(parts, cap, dome, shape.sides, glm::vec3(0));
    return parts;
}

void addChains(SceneAsset& asset, uint32_t mesh, const PillarShape& shape, float seconds) {
    if (asset.animations.empty()) asset.animations.push_back({.name = "sway", .duration = seconds});
    weighVertices(asset, mesh, shape);
    for (uint32_t node = 0, count = uint32_t(asset.nodes.size()); node < count; ++node)
        if (asset.nodes[node].mesh == int32_t(mesh))
            asset.nodes[node].skin = int32_t(addChain(asset, node, shape, seconds));
}

SceneAsset figures(uint32_t param) {
    constexpr float kSeconds = 3;
    const uint32_t count = param ? param : 16;
    SceneBuilder b("figures");
    const uint32_t floor = b.material("floor", {0.55f, 0.53f, 0.50f}),
                   red = b.material("red", {0.63f, 0.065f, 0.05f}),
                   green = b.material("green", {0.14f, 0.45f, 0.091f}),
                   white = b.material("white", {0.73f, 0.72f, 0.69f}),
                   body = b.material("body", {0.66f, 0.52f, 0.30f}),
                   cap = b.material("cap", {0.25f, 0.35f, 0.62f});
    const float side = std::sqrt(float(count)), half = 0.55f * side + 1;
    b.room("walls", {-half, 0, -half}, {half, 2.6f, half}, {red, green, floor, ~0u, white, ~0u});
    const PillarShape shape;
    uint32_t first = ~0u;
    for (uint32_t i = 0; i < count; ++i) {
        const auto columns = uint32_t(std::ceil(side));
        const glm::vec3 at((float(i % columns) + 0.5f - 0.5f * float(columns)) * 1.1f, 0,
                           (float(i / columns) + 0.5f - 0.5f * float(columns)) * 1.1f);
        const uint32_t place = b.place(fmt::format("place {}", i), at, 6.2831853f * io::hashToUnit(i));
        const std::string name = fmt::format("figure {}", i);
        const uint32_t node = first == ~0u ? b.model(name, pillarParts(shape, body, cap), glm::vec3(0))
                                           : b.copy(first, name, glm::vec3(0));
        if (first == ~0u) first = node;
        b.attach(node, place);
        b.node(node).extras.clipStart = kSeconds * io::hashToUnit(7 * i + 1);
    }
    const float height = half + 3;
    b.spot("lamp", {-0.5f * half, height, 0.6f * half}, {0.4f, -1, -0.5f}, glm::vec3(3 * height * height),
           {34, 52});
    b.camera("camera", {0.3f * half, 0.3f * half + 1.2f, 1.1f * half + 1}, {0, 0.7f, 0}, 50);
    const auto mesh = uint32_t(b.node(first).mesh);
    SceneAsset asset = b.finish();
    addChains(asset, mesh, shape, kSeconds);
    return asset;
}

}  // namespace ag::scenegen
