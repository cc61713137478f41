// Rays to texels of reflective shadow maps: what area lights and their imperfect shadow maps get wrong,
// measured at each pixel with a ray or two.
#ifndef AG_TEXEL_RAYS_IO_H
#define AG_TEXEL_RAYS_IO_H

#include "val_shading/val_shading_io.h"

#ifdef __cplusplus
namespace ag::io {
#endif

const uint kDrawBlock = 8;  // pixels along the side of a block whose pixels draw lights alike; divides a tile
const float kNoRays = -1.0f;  // in the place of the light that a pixel drew: it cast none in this frame

struct CastPush {
    ValShadingPush tiles;
    uint atlasWidth;  // texels, of the maps
    uint mapCount;    // of lights
    uint step;        // another in each frame with new rays
    vec3 shift;       // of the noise: the numbers a pixel draws for a direction, and for a light
    float offset;     // m: rays leave and reach surfaces so far before them
    float reach;      // m: of rays to whatever is near
    uint known;       // 0: there is no frame before
};

struct ChoosePush {
    ValShadingPush tiles;
    uint step;   // another in each frame with new rays
    uint known;  // 0: there is no frame before
};

struct RayAccumulatePush {
    float near;        // m
    uint valid;        // 0: there is no frame before
    float mostLength;  // frames that a mean stands for
};

#ifdef __cplusplus
}  // namespace ag::io
#endif
#endif
