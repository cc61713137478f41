// A town of a square kilometre: what a world of many things is measured on.
#pragma once

#include "engine/scene/scene_asset.h"

namespace ag::scenegen {

// 16 x 16 blocks between streets: 1,024 houses with windows and furnished rooms, trees, benches, 500 lamps,
// under sun and sky; `param` walkers and carts (default 10,000) go to and fro along the streets. Its cameras
// are the stops of a drive round nine blocks.
SceneAsset town(uint32_t param);

}  // namespace ag::scenegen
