// Irradiance straight from the scene's suns, one pass each.
#pragma once

#include "engine/renderer/shadow_maps.h"
#include "gi/surfaces.h"
#include "gi/val_shading.h"

namespace ag::render {

gi::Irradiance addSunLighting(GraphScope scope, const SceneView& scene, const gi::Surfaces& gbuffer,
                              const ShadowMaps& shadows);

}  // namespace ag::render
