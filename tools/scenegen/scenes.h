// The built-in scenes, each a short function that can be read like a description.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "engine/core/result.h"
#include "engine/scene/scene_asset.h"

namespace ag::scenegen {

// `param` is the scene's number, where it takes one; 0 is its default.
Result<SceneAsset> buildScene(std::string_view name, uint32_t param);
// A built-in name, or a glTF or GLB file.
Result<SceneAsset> resolveScene(const std::string& nameOrPath, uint32_t param);
bool isBuiltIn(std::string_view name);
std::span<const std::string_view> sceneNames();

}  // namespace ag::scenegen
