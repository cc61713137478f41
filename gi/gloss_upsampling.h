// Gloss of every n-th pixel brought to every pixel: of the cells about a pixel those whose surface reflects
// the same way. What turns, shines or is made otherwise meets the lights by itself.
#pragma once

#include "gi/surfaces.h"
#include "gi/val_shading.h"

namespace ag::gi {

// `gloss`: of `cells`, W/(m² sr), which have albedo and reflectance; comes back as it is if those are all
// pixels. `settings`: shape and taps of near lights serve for all of those met so.
ImageHandle addGlossUpsampling(GraphScope scope, const Surfaces& all, const Surfaces& cells,
                               ImageHandle gloss, const ShadowedVals& lights,
                               const ValShadingSettings& settings);

}  // namespace ag::gi
