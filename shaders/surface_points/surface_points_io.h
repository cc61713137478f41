// Points on the scene's surfaces, to stand for them in small shadow maps.
#ifndef AG_SURFACE_POINTS_IO_H
#define AG_SURFACE_POINTS_IO_H

#include "common/portable.h"

#ifdef __cplusplus
namespace ag::io {
#endif

struct SurfaceEdge {  // where a flat piece of surface ends, seen from a point on it
    vec3 inward;      // unit, in the surface, away from the edge; zero: no end
    float distance;   // m
};

struct SurfaceSample {  // 4 vec4: where on which instance, moving with it
    vec3 positionLocal;
    uint instance;
    vec3 normalLocal;  // unit, of the triangle
    uint unused;
    SurfaceEdge edgesLocal[2];
};

struct SurfacePoint {  // 4 vec4
    vec3 position;     // m
    float unused0;
    vec3 normal;  // unit
    float unused1;
    SurfaceEdge edges[2];
};

#ifdef __cplusplus
}  // namespace ag::io
#endif
#endif
