// Constants of the kernels of gloss rays. Scalar layout.
#ifndef AG_GLOSS_RAYS_IO_H
#define AG_GLOSS_RAYS_IO_H

#include "common/pixel_rays.h"

#ifdef __cplusplus
namespace ag::io {
#endif

struct GlossCastPush {
    uint atlasWidth;                 // texels, of reflective shadow maps
    uint mapCount;                   // of lights
    uint valCount;                   // area lights,
    uint firstLater;                 // the first of them that stands for later bounces
    uint lightCount;                 // without maps
    uint step;                       // another in each frame with new rays
    vec3 shift;                      // of the noise
    float offset;                    // m: rays leave and reach surfaces so far before them at least
    float pixelOffset, texelOffset;  // the same in these pixels and in texels
    float reach;                     // m: beyond it nothing stands
    float emissiveArea;              // m² that a point of emissive surfaces stands for
    float laterReach;                // m: nearer surfaces are found by rays, not by draws to points
};

struct GlossMixPush {
    PixelRays rays;
    float near;    // m
    uint valid;    // 0: there is no frame before
    float trust;   // in what rays found, at most
    float fading;  // share of what was found before the last change that stays
    int stride;    // pixels to those that trust is found at: of every turn some
};

#ifdef __cplusplus
}  // namespace ag::io
#endif
#endif
