// Gloss of every n-th pixel brought to every pixel: of the cells about a pixel those whose surface reflects
// the same way. What turns, shines or is made otherwise meets the lights by itself.
#pragma once

#include "gi/surfaces.h"
#include "gi/val_shading.h"
#include "gi/val_tiles.h"

namespace ag::gi {

// `gloss`: of the tiles' cells, W/(m² sr), which have albedo and reflectance; comes back as it is if those
// are all pixels.
ImageHandle addGlossUpsampling(const Surfaces& all, const ValTiles& tiles, ImageHandle gloss,
                               const ValShadingSettings& settings);

}  // namespace ag::gi
