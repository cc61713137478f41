// Irradiance from every texel of the RSMs as a point emitter (Dachsbacher & Stamminger 2005 without
// their sampling): slow, and exact but for visibility as the maps grow.
#pragma once

#include "gi/rsm.h"
#include "gi/val_shading.h"

namespace ag::gi {

Irradiance addTexelShading(GraphScope scope, const Surfaces& gbuffer, const RsmSet& rsm);

}  // namespace ag::gi
