// Constants of the kernels of reflections on screen. Scalar layout.
#ifndef AG_REFLECTIONS_IO_H
#define AG_REFLECTIONS_IO_H

#include "common/pixel_rays.h"

#ifdef __cplusplus
namespace ag::io {
#endif

struct ReflectionsMarchPush {
    uint rays, steps;  // of a pixel; of a ray, at most
    float thickness;   // share of its distance that a surface is thick at least
};

struct ReflectionsMixPush {
    PixelRays rays;
    float roughness;   // from here on lobes are left to area lights
    float pixelAngle;  // radians
};

#ifdef __cplusplus
}  // namespace ag::io
#endif

// How much of a lobe is looked for on screen: all of it well below the roughest, then less and less.
#ifndef __cplusplus
float smoothShare(float roughness, float roughest) {
    return clamp(5.0 - 5.0 * roughness / roughest, 0.0, 1.0);
}
#endif
#endif
