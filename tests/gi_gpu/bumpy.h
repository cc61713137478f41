// Scenes whose surfaces have normal maps.
#pragma once

#include <cmath>
#include <functional>
#include <glm/gtc/constants.hpp>

#include "engine/scene/scene_asset.h"

namespace ag::test {

// Everything has the map, of 256² texels. `normalAt` a texel: unit, in tangent space.
inline SceneAsset withNormalMap(SceneAsset asset, const std::function<glm::vec3(glm::uvec2)>& normalAt) {
    constexpr uint32_t kSize = 256;
    std::vector<uint8_t> texels(size_t(kSize) * kSize * 4, 255);
    for (uint32_t i = 0; i < kSize * kSize; ++i) {
        const glm::vec3 n = normalAt({i % kSize, i / kSize});
        for (int c = 0; c < 3; ++c)
            texels[i * 4 + size_t(c)] = uint8_t(std::lround(127.5f + 127.5f * n[c]));
    }
    GeometryArrays& g = asset.geometry;
    g.textures[size_t(TextureClass::k256)].linear.push_back(std::move(texels));
    for (Material& m : g.materials)
        m.textureClass = TextureClass::k256, m.normalLayer = 0;
    return asset;
}

// Waves of 16 texels, four of them a metre, up to so steep, in the axis-aligned walls of a scene.
inline SceneAsset withWaves(SceneAsset asset, float steepest = 0.36f) {
    asset = withNormalMap(std::move(asset), [&](glm::uvec2 texel) {
        const glm::vec2 phase = glm::vec2(texel) * (glm::two_pi<float>() / 16);
        return glm::normalize(glm::vec3(steepest * std::sin(phase.x), steepest * std::sin(phase.y), 1));
    });
    GeometryArrays& g = asset.geometry;
    for (size_t v = 0; v < g.positions.size(); ++v) {
        const glm::vec3 p = g.positions[v];  // relative to their nodes
        g.attributes[v].uv = glm::vec2(p.x + 0.4f * p.z, p.y + 0.6f * p.z) / 4.0f;
    }
    return asset;
}

}  // namespace ag::test
