// A surface's edge to where its instance is. Needs scene.glsl.
#ifndef AG_PLACE_EDGE_GLSL
#define AG_PLACE_EDGE_GLSL

#include "surface_points/surface_points_io.h"

SurfaceEdge edgeOf(vec4 stored) { return SurfaceEdge(stored.xyz, stored.w); }

SurfaceEdge placeEdge(InstanceTransform t, SurfaceEdge local) {
    vec3 d = transformDirection(t, local.inward);
    float scale = length(d);
    return SurfaceEdge(d / max(scale, 1e-20), local.distance < 0.0 ? local.distance : local.distance * scale);
}
#endif
