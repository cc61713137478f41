#pragma once

#include "engine/scene/scene_asset.h"

namespace ag::scenegen {

// The level: four rooms in a row, each about one thing light does, and a garden behind them.
SceneAsset gallery(uint32_t param);

}  // namespace ag::scenegen
