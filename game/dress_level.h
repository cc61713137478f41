// What a level's file does not hold: textures of its materials, drawn at the start by the materials' names,
// and its sky. A file of plain colours is so a level of plaster, oak and cloth.
#pragma once

#include "engine/core/result.h"
#include "engine/scene/scene_asset.h"

namespace ag::game {

// A level's file, dressed. The error is one sentence.
Result<SceneAsset> readLevel(const std::string& path);

// The clear sky that a level asks for, by a node with the tag "sky".
struct LevelDaylight {
    glm::vec3 sunDirection{0};  // `axis`: the way the sun's light travels, unit, downwards
    float amount = 0;           // of full daylight; 0: the level has no sky
};
LevelDaylight daylightOf(const SceneAsset& level);
Sky skyOf(const LevelDaylight& daylight);
void addSky(SceneAsset& level);
// Materials whose names end in a known substance ("oak", "plaster") get its picture and bumps, laid over all
// faces in meters; their mean albedo stays. Materials that have textures stay as they are.
void addTextures(SceneAsset& level);

}  // namespace ag::game
