// Points on surfaces as texels of RSMs, beside those of the lights: some reflect what fell on them a frame
// ago (see later_bounces.h), others lie on surfaces that shine by themselves. They are clustered, get shadow
// maps and light the screen like any lit texel, out of the same budget.
#pragma once

#include "gi/inputs.h"

namespace ag::gi {

struct LaterBouncesSettings;
struct Settling;

// A square map of points.
struct PointMap {
    uint32_t side = 0;        // texels, a power of two; 0: there is none
    uint32_t firstPoint = 0;  // its first texel of SurfaceEmitters::texels
    uint32_t count() const { return side * side; }
};

struct SurfaceEmitters {
    BufferHandle texels;       // io::RsmTexel, map by map, tile by tile; invalid: there are none
    BufferHandle edges;        // io::SurfaceEdge, two a point: where its surface ends
    HistoryBuffer irradiance;  // vec4: W/m² on the points that reflect
    PointMap reflecting, emissive;
    float reflectingShare = 0;  // of all clusters
    float emissiveFlux = 0;     // W, mean of the channels
    float otherFlux = 0;        // the same of World::otherLights
};

// `skyStep`: another number whenever the sky's light on the points may have changed; 0: no sky.
SurfaceEmitters addSurfaceEmitters(GraphScope scope, const World& world, const Occluders& occluders,
                                   uint64_t skyStep, const LaterBouncesSettings& settings,
                                   Settling& settling);

}  // namespace ag::gi
