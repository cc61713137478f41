// The denoiser's settings.
#ifndef AG_DENOISER_IO_H
#define AG_DENOISER_IO_H

#include "common/pixel_rays.h"

#ifdef __cplusplus
namespace ag::io {
#endif

const uint kDenoiserTile = 8;  // pixels along the side of a tile of statistics

struct ReprojectPush {
    float near;  // m
    uint valid;  // 0: there is no frame before
    uint seed;   // another in each frame
};

struct AccumulatePush {
    float leastShare;  // of a new sample, once the history is long
    float mostLength;  // frames
    uint spread;       // 1: what stands out of a tile's samples is shared out among its pixels
    uint changing;     // 1: where light changes beyond noise the history counts for less
    uint seed;         // another in each frame
};

struct FilterPush {
    int strideX, strideY;  // pixels from tap to tap; one of them 0: a line of five, else a square of 25
    float lightTolerance;  // standard deviations by which taps may differ; 0: any
    uint seed;             // another in each frame
};

#ifdef __cplusplus
}  // namespace ag::io
#endif
#endif
