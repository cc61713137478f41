// Irradiance straight from the scene's lights with 25-tap shadows, one pass a light. Many lights at once are
// the business of light clustering, not of this list.
#pragma once

#include "gi/gbuffer.h"
#include "gi/shadow_maps.h"
#include "gi/val_shading.h"

namespace ag::gi {

Irradiance addDirectLighting(FrameGraph& graph, const SceneView& scene, const GBuffer& gbuffer,
                             const ShadowMaps& shadows);

}  // namespace ag::gi
