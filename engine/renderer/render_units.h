// The scene in the units it is rendered in (gi/units.h).
#pragma once

#include "engine/scene/render_scene.h"
#include "gi/units.h"

namespace ag::render {

using gi::RenderUnits;

// Those of the frame before as long as they fit: changing them loses all that is carried over. `emission`: of
// the brightest material, W/(m² sr).
RenderUnits chooseUnits(const RenderScene& scene, float emission, RenderUnits before);

// `scene` in those units. Exact but for numbers that leave the range of floats. `generation` counts the
// changes of units: versions of different ones differ. Where `out` is the scene of the frame before,
// only what changed is written.
void inUnits(const RenderScene& scene, RenderUnits units, uint64_t generation, RenderScene& out);

}  // namespace ag::render
