// Light of every n-th pixel brought to every pixel.
#ifndef AG_UPSAMPLING_IO_H
#define AG_UPSAMPLING_IO_H

#include "common/pixel_rays.h"

AG_BEGIN

struct UpsamplingPush {
    PixelRays rays;   // of all pixels
    float footprint;  // m that two gathered pixels cover at 1 m depth
    float near;       // m
    uint spacing;     // pixels from one that was gathered to the next
    uvec2 place;      // of those in squares of so many
};

AG_END
#endif
