// The means that what rays found at pixels goes into, and the filter it goes through.
#ifndef AG_RAY_FILTER_IO_H
#define AG_RAY_FILTER_IO_H

#include "common/pixel_rays.h"

#ifdef __cplusplus
namespace ag::io {
#endif

struct RayMeanPush {
    float near;        // m
    uint valid;        // 0: there is no frame before
    float mostLength;  // frames that a mean stands for
    uint moving;       // 1: something may have changed what rays find
};

struct RayFilterPush {
    int stride;       // pixels from tap to tap
    float tolerance;  // standard deviations by which the light of taps may differ
};

struct JoinPush {
    PixelRays rays;
    float near;  // m
    RayFilterPush filterBy;
};

#ifdef __cplusplus
}  // namespace ag::io
#endif
#endif
