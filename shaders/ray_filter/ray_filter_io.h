// The filter that what rays found at pixels goes through.
#ifndef AG_RAY_FILTER_IO_H
#define AG_RAY_FILTER_IO_H

#include "common/pixel_rays.h"

#ifdef __cplusplus
namespace ag::io {
#endif

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
