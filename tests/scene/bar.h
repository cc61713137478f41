// The smallest skinned mesh whose every vertex is known.
#pragma once

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "engine/scene/scene_asset.h"

namespace ag::test {

// A bar, one triangle from 0 to 2 along y with joints at 0 and 1; the upper one turns by a right angle
// about z, under a frame that stands aside and is twice as large.
inline SceneAsset bar() {
    SceneAsset asset;
    asset.geometry.positions = {{0.1f, 0, 0}, {0.3f, 1, 0}, {0.1f, 2, 0}};
    asset.geometry.attributes.assign(3, {.normal = {1, 0, 0}, .tangent = {0, 1, 0, 1}});
    asset.geometry.skin = {
        {{0, 0, 0, 0}, {1, 0, 0, 0}}, {{0, 1, 0, 0}, {0.5f, 0.5f, 0, 0}}, {{1, 0, 0, 0}, {1, 0, 0, 0}}};
    asset.geometry.indices = {0, 1, 2};
    asset.geometry.materials.emplace_back();
    Primitive p{.indexCount = 3};
    for (const glm::vec3 at : asset.geometry.positions)
        p.boundsLocal.add(at);
    asset.geometry.primitives = {p};
    asset.meshes = {{"bar", 0, 1}};
    asset.nodes = {{.name = "frame", .local = {.translation = {5, 0, 0}, .scale = glm::vec3(2)}},
                   {.name = "lower", .parent = 0, .depth = 1},
                   {.name = "upper", .parent = 1, .depth = 2, .local = {.translation = {0, 1, 0}}},
                   {.name = "bar", .local = {.translation = {100, 100, 100}}, .mesh = 0, .skin = 0}};
    asset.skins = {{"chain", {1, 2}, {glm::mat4(1), glm::translate(glm::mat4(1), glm::vec3(0, -1, 0))}}};
    const float s = std::sqrt(0.5f);
    asset.animations = {{"bend",
                         1,
                         {{.node = 2,
                           .path = ChannelPath::kRotation,
                           .times = {0, 1},
                           .values = {{0, 0, 0, 1}, {0, 0, s, s}}}}}};
    return asset;
}

}  // namespace ag::test
