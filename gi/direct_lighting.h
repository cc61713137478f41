// Irradiance straight from the scene's suns, one pass each.
#pragma once

#include "gi/gbuffer.h"
#include "gi/shadow_maps.h"
#include "gi/val_shading.h"

namespace ag::gi {

Irradiance addSunLighting(GraphScope scope, const SceneView& scene, const GBuffer& gbuffer,
                          const ShadowMaps& shadows);

}  // namespace ag::gi
