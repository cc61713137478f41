// Points on the scene's surfaces, to stand for them in small shadow maps.
#ifndef AG_SURFACE_POINTS_IO_H
#define AG_SURFACE_POINTS_IO_H

#include "common/portable.h"

#ifdef __cplusplus
namespace ag::io {
#endif

struct SurfaceSample {  // 2 vec4: where on which instance, moving with it
    vec3 positionLocal;
    uint instance;
    vec3 normalLocal;  // unit, of the triangle
    uint unused;
};

struct SurfacePoint {  // 2 vec4
    vec3 position;     // m
    float unused0;
    vec3 normal;  // unit
    float unused1;
};

#ifdef __cplusplus
}  // namespace ag::io
#endif
#endif
