// Rays to texels of reflective shadow maps: what area lights and their imperfect shadow maps get wrong,
// measured at each pixel with some rays.
#ifndef AG_TEXEL_RAYS_IO_H
#define AG_TEXEL_RAYS_IO_H

#include "common/pixel_rays.h"
#include "val_shading/val_shading_io.h"

#ifdef __cplusplus
namespace ag::io {
#endif

const uint kDrawBlock = 8;  // pixels along the side of a block whose pixels draw lights alike; divides a tile

// What a block's rays to texels of a light brought.
struct RaysFound {
    float count;    // of rays
    float squares;  // sum of the squares of the luminance that the light would send if all rays found this
};

struct CastPush {
    ValShadingPush tiles;
    uint atlasWidth;  // texels, of the maps
    uint mapCount;    // of lights
    // Maps of points that shine and of those that reflect; none: beyond all maps.
    uint emissiveMap, laterMap;
    uint ray;      // number of the frame's rays
    vec3 shift;    // of the noise: the numbers a pixel draws for a direction, and for a light
    float offset;  // m: rays leave and reach surfaces so far before them at least
    // The same in these pixels and in texels: a rasteriser draws between corners it has moved, and so beside
    // surfaces.
    float pixelOffset, texelOffset;
    float reach;  // m: of rays to whatever is near
    // m, at most the reach: surfaces are met by such rays, and draws to points have those beyond.
    float emissiveReach, laterReach;
};

struct ChoosePush {
    ValShadingPush tiles;
    uint ray;         // number of the frame's rays
    uint known;       // 0: there are no rays before
    float mostKnown;  // rays remembered of a light
};

struct RayAccumulatePush {
    float near;        // m
    uint valid;        // 0: there is no frame before
    float mostLength;  // frames that a mean stands for
    uint moving;       // 1: something may have changed what rays find
};

struct CarryPush {
    float near;     // m
    uint valid;     // 0: there is no frame before
    float dimming;  // at most 1: of the light that dimmed least since the frame before
};

struct RegressPush {
    float few;  // frames: the variance of so few is not to be believed
};

struct CorrectPush {
    uint valid;    // 0: there is no frame before
    float fading;  // share of what is carried that stays, a frame
    uint moving;   // 1: surfaces may have been at other pixels
};

#ifdef __cplusplus
}  // namespace ag::io
#endif
#endif
