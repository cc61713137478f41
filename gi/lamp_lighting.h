// Irradiance straight from spots and points, however many: tiles of the screen list the lamps that reach
// them, and a cluster's visibility, as from a disk of its radius (PCSS), is found once a pixel for all of its
// lamps (LightCluster). Difference: no image of each cluster's visibility is kept; no pixel meets lamps out
// of reach.
#pragma once

#include "gi/gbuffer.h"
#include "gi/lamp_shadows.h"
#include "gi/val_shading.h"
#include "shaders/direct_lighting/direct_lighting_io.h"

namespace ag::gi {

struct LampLightingSettings {
    bool tiles = true;       // off: every pixel meets all lamps in view
    uint32_t softTaps = 12;  // of a cluster's shadow
};

struct LampLightingHistory {  // scratch, so that a steady frame allocates nothing
    std::vector<io::Lamp> lamps;
    std::vector<uint32_t> order;
};

// Adds to `before`, or starts anew where that has no image.
Irradiance addLampLighting(FrameGraph& graph, const SceneView& scene, const GBuffer& gbuffer,
                           const LightClusters& clusters, const LampShadows& shadows, Irradiance before,
                           const LampLightingSettings& settings, LampLightingHistory& history);

}  // namespace ag::gi
