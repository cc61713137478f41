// Irradiance from virtual area lights: every pixel meets every light, unshadowed.
#pragma once

#include "gi/gbuffer.h"
#include "gi/val_fit.h"

namespace ag::gi {

enum class ValShape : uint32_t {
    kPoint,       // the cluster as a point emitter
    kDisk,        // RSMC eq. 2, ACRSM eq. 3.9: as published, loses energy near the light
    kVectorDisk,  // closed form of the disk's vector irradiance
};

struct ValShadingSettings {
    bool enabled = true;  // off: no indirect light, and nothing that only it needs
    ValShape shape = ValShape::kVectorDisk;
};

struct Irradiance {
    ImageHandle image;  // rgba16f, W/m²; invalid: no light, nothing to add
};

Irradiance addValShading(FrameGraph& graph, const SceneView& scene, const GBuffer& gbuffer, const Vals& vals,
                         const ValShadingSettings& settings);

}  // namespace ag::gi
