// Light of every n-th pixel brought to every pixel.
#ifndef AG_UPSAMPLING_IO_H
#define AG_UPSAMPLING_IO_H

#include "common/pixel_rays.h"

AG_BEGIN

struct UpsamplingPush {
    PixelRays rays;   // of all pixels
    float footprint;  // m between neighbours that have light, at 1 m depth, twice
    float near;       // m
    uint step;        // pixels from one that has light to the next
};

AG_END
#endif
