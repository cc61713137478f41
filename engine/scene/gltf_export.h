// A SceneAsset as one .glb: geometry, materials without textures, nodes with extras, lights, cameras, skins,
// animations.
#pragma once

#include <string>

#include "engine/core/result.h"
#include "engine/scene/scene_asset.h"

namespace ag {

// Assets with textures are refused: only generated scenes are written.
Status exportGlb(const SceneAsset& asset, const std::string& path);

}  // namespace ag
