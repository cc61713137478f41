// Irradiance of every n-th pixel brought to every pixel: bilinearly among those on the same surface (joint
// bilateral upsampling, Kopf et al. 2007); the few pixels without any look farther for what is most alike.
#pragma once

#include "gi/gbuffer.h"
#include "gi/val_shading.h"

namespace ag::gi {

// Light of all pixels comes back as it is.
Irradiance addUpsampling(FrameGraph& graph, const SceneView& scene, const GBuffer& gbuffer,
                         const Irradiance& gathered);

}  // namespace ag::gi
