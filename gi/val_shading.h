// Irradiance from virtual lights: every pixel meets every light, unshadowed. The lights are fitted to
// clusters, or they are the light maps' texels themselves.
#pragma once

#include "gi/gbuffer.h"
#include "gi/val_fit.h"

namespace ag::gi {

enum class ValShape : uint32_t {
    kPoint,       // the cluster as a point emitter
    kDisk,        // RSMC eq. 2, ACRSM eq. 3.9: as published, loses energy near the light
    kVectorDisk,  // closed form of the disk's vector irradiance
    kRectangle,   // the rectangle of the cluster's second moments by its edges
};

struct ValShadingSettings {
    ValShape shape = ValShape::kRectangle;
};

// Every texel of the light maps as a point emitter (Dachsbacher & Stamminger 2005 without their sampling):
// slow, and exact but for visibility as the maps grow.
Vals texelsAsVals(const RsmSet& rsm);

struct Irradiance {
    ImageHandle image;  // rgba16f, W/m²; invalid: no light, nothing to add
};

Irradiance addValShading(FrameGraph& graph, const SceneView& scene, const GBuffer& gbuffer, const Vals& vals,
                         const ValShadingSettings& settings);

}  // namespace ag::gi
