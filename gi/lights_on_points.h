// Light of more lights than have reflective shadow maps: where it lands on the points that reflect, its first
// bounce begins, and all that follow, as coarse as those.
#pragma once

#include "gi/inputs.h"
#include "gi/surface_emitters.h"

namespace ag::gi {

// The lights without a reflective shadow map, as rays read them.
struct OtherLights {
    BufferHandle rows;  // io::PointLight; invalid: there are none
    uint32_t count = 0;
};
OtherLights addOtherLights(GraphScope scope, std::span<const RsmLight> lights);

// vec4 a point, W/m². Invalid: there are no such lights, no points, or nothing to cast rays into yet.
BufferHandle addLightsOnPoints(GraphScope scope, const SurfaceEmitters& emitters, const OtherLights& lights,
                               const Occluders& occluders);

}  // namespace ag::gi
