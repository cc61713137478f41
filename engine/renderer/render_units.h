// The units a scene is rendered in: powers of 32 near its size and its light. Half floats then hold its
// light, and a small constant in a kernel means the same at any scale. Scenes of everyday size and light keep
// metres and watts.
#pragma once

#include "engine/scene/render_scene.h"

namespace ag::render {

struct RenderUnits {
    float length = 1;  // m
    float light = 1;   // W/m² of irradiance, W/(m² sr) of radiance

    bool operator==(const RenderUnits&) const = default;
};

// Those of the frame before as long as they fit: changing them loses all that is carried over. `emission`: of
// the brightest material, W/(m² sr).
RenderUnits chooseUnits(const RenderScene& scene, float emission, RenderUnits before);

// A length that the scene fits in, and that stays while things move at its edge: for grids and ranges that
// shall look the same at any scale. Chosen anew when the scene outgrows it or has left most of it. 0: no
// scene yet.
float steadyExtent(const Bounds& bounds, float before);

// `scene` in those units. Exact but for numbers that leave the range of floats. `generation` counts the
// changes of units: versions of different ones differ.
void inUnits(const RenderScene& scene, RenderUnits units, uint64_t generation, RenderScene& out);

}  // namespace ag::render
