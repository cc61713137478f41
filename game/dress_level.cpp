#include "game/dress_level.h"

#include <array>
#include <map>

#include "engine/scene/gltf_import.h"
#include "game/substances.h"

namespace ag::game {
namespace {

constexpr float kTurbidity = 4;

// The axis a face looks along most: 0, 1 or 2.
int faceAxis(glm::vec3 a, glm::vec3 b, glm::vec3 c) {
    const glm::vec3 n = glm::abs(glm::cross(b - a, c - a));
    return n.x >= n.y && n.x >= n.z ? 0 : n.y >= n.z ? 1 : 2;
}

// Walls upright, floors as seen from above.
glm::vec2 placeOn(int axis, glm::vec3 p) {
    if (axis == 0) return {p.z, -p.y};
    if (axis == 1) return {p.x, p.z};
    return {p.x, -p.y};
}

// Each triangle is seen along its own axis: vertices that two axes share are there twice.
void layOver(GeometryArrays& g, Primitive& primitive, float meters, bool upright) {
    std::map<std::pair<uint32_t, int>, uint32_t> copies;
    const uint32_t first = uint32_t(g.positions.size());
    for (uint32_t i = 0; i + 2 < primitive.indexCount; i += 3) {
        uint32_t* corner = &g.indices[primitive.firstIndex + i];
        const auto old = [&](uint32_t k) { return uint32_t(primitive.vertexOffset) + corner[k]; };
        const int axis = faceAxis(g.positions[old(0)], g.positions[old(1)], g.positions[old(2)]);
        for (uint32_t k = 0; k < 3; ++k) {
            const uint32_t vertex = old(k);
            const auto [at, isNew] = copies.try_emplace({vertex, axis}, uint32_t(g.positions.size()) - first);
            if (isNew) {
                const glm::vec3 position = g.positions[vertex];
                VertexAttributes attributes = g.attributes[vertex];
                attributes.uv = placeOn(axis, position) / meters;
                // Grain runs along what is longer.
                if (upright && axis != 1) std::swap(attributes.uv.x, attributes.uv.y);
                attributes.tangent = glm::vec4(0);
                g.positions.push_back(position);
                g.attributes.push_back(attributes);
                if (!g.skin.empty()) g.skin.push_back(g.skin[vertex]);
            }
            corner[k] = at->second;
        }
    }
    primitive.vertexOffset = int32_t(first);
}

bool isUpright(const Primitive& primitive) {
    const glm::vec3 size = primitive.boundsLocal.max - primitive.boundsLocal.min;
    return size.y > size.x && size.y > size.z;
}

}  // namespace

void addTextures(SceneAsset& level) {
    GeometryArrays& g = level.geometry;
    TextureLayers& layers = g.textures[size_t(TextureClass::k256)];
    std::map<std::string_view, std::pair<int32_t, float>> drawn;  // layer and mean, by substance
    std::vector<std::optional<Substance>> substances;
    for (Material& m : g.materials) {
        const auto substance = m.textureClass == TextureClass::kNone ? substanceOf(m.name) : std::nullopt;
        substances.push_back(substance);
        if (!substance) continue;
        auto found = drawn.find(substance->name);
        if (found == drawn.end()) {
            SubstancePictures pictures = drawSubstance(*substance);
            found = drawn.insert({substance->name, {int32_t(layers.srgb.size()), pictures.mean}}).first;
            layers.srgb.push_back(std::move(pictures.color));
            layers.linear.push_back(std::move(pictures.normal));
        }
        const auto [layer, mean] = found->second;
        m.textureClass = TextureClass::k256;
        m.baseColorLayer = m.normalLayer = layer;
        const glm::vec3 albedo = glm::min(glm::vec3(m.baseColor) / mean, glm::vec3(1));
        m.baseColor = glm::vec4(albedo, m.baseColor.w);
    }
    for (Primitive& primitive : g.primitives)
        if (const auto& s = substances[primitive.material])
            layOver(g, primitive, s->meters, s->name == "wood" && isUpright(primitive));
}

LevelDaylight daylightOf(const SceneAsset& level) {
    for (const SceneNode& node : level.nodes)
        if (node.extras.tag == "sky" && glm::length(node.extras.axis) >= 0.5f)
            return {glm::normalize(node.extras.axis), node.extras.amount};
    return {};
}

Sky skyOf(const LevelDaylight& daylight) {
    Sky sky = analyticSky(daylight.sunDirection, kTurbidity);
    for (glm::vec3& radiance : sky.radiance.pixels)
        radiance *= daylight.amount;
    sky.turbidity = 0;  // it is of another strength
    return sky;
}

void addSky(SceneAsset& level) {
    const LevelDaylight daylight = daylightOf(level);
    if (daylight.amount > 0) level.sky = std::make_shared<const Sky>(skyOf(daylight));
}

Result<SceneAsset> readLevel(const std::string& path) {
    auto level = importGltf(path);
    if (!level) return level.error();
    addSky(*level);
    addTextures(*level);
    return level;
}

}  // namespace ag::game
