// A room that nobody tuned anything for: drawn by chance, another one for each number.
#pragma once

#include "engine/scene/scene_asset.h"

namespace ag::scenegen {

// 3 to 10 m wide, walls of 1 to 30 cm with windows to the floor or above it, the sun, sometimes a lamp, and
// up to 14 things: crates, columns, balls, tables with thin legs, sheets that are seen from both sides.
SceneAsset room(uint32_t param);

}  // namespace ag::scenegen
