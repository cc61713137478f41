// The units a scene is rendered in: powers of 32 near its size and its light. Half floats then hold its
// light, and a small constant in a kernel means the same at any scale. Scenes of everyday size and light keep
// metres and watts.
#pragma once

#include "engine/core/bounds.h"

namespace ag::gi {

struct RenderUnits {
    float length = 1;  // m
    float light = 1;   // W/m² of irradiance, W/(m² sr) of radiance

    bool operator==(const RenderUnits&) const = default;
};

// Those of before as long as they fit: changing them loses all that is carried over. `irradiance`: about the
// most that there is, W/m²; see irradianceOf.
RenderUnits chooseUnits(const Bounds& bounds, float irradiance, RenderUnits before);
// What a light makes in a scene of some diagonal, m: a quarter of it away, or as far as it reaches.
float irradianceOf(glm::vec3 intensity, bool directional, float range, float diagonal);

// A length that the scene fits in, and that stays while things move at its edge: for grids and ranges that
// shall look the same at any scale. Chosen anew when the scene outgrows it or has left most of it. 0: no
// scene yet.
float steadyExtent(const Bounds& bounds, float before);

// How far from surfaces rays start and end at least: short, so that what is in a crease is met and a thin
// sheet hides what is behind it; but more than coordinates are rounded by, which matters far from the origin.
// `extent`: steadyExtent's; all in units of length.
float rayOffset(const Bounds& bounds, float extent);

}  // namespace ag::gi
