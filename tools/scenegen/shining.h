// Scenes whose light is not that of lamps alone: signs that shine, a sky, polished things.
#pragma once

#include "engine/scene/scene_asset.h"

namespace ag::scenegen {

// An alley at night, 6 x 5 x 12 m between two fronts: panels, tubes and a globe shine, and there is no other
// light. A canopy and crates stand in the way.
SceneAsset neon(uint32_t param);
// A court between four wings with an arcade at one side, 12 x 12 m, under sun and sky.
SceneAsset courtyard(uint32_t param);
// Spheres of metal and of enamel with five roughnesses before a window front, under sky, sun, a lamp and a
// sign.
SceneAsset showroom(uint32_t param);

// Panes of tinted glass and of half-covering sheets one behind another, and a ball of glass, under sky, sun
// and a lamp.
SceneAsset panes(uint32_t param);

}  // namespace ag::scenegen
