// First-bounce irradiance from samples of an RSM about each pixel's projection.
#ifndef AG_STOCHASTIC_RSM_IO_H
#define AG_STOCHASTIC_RSM_IO_H

#include "common/portable.h"

#ifdef __cplusplus
namespace ag::io {
#endif

struct StochasticRsmPush {
    uint map;          // which RsmMap
    uint sampleCount;  // of the pattern
    float radius;      // of the disk about the projection, in widths of the map
    uint step;         // pixels from one gathered pixel to the next
    uint atlasWidth;   // texels
    vec2 shift;        // of the pattern in this frame, where it differs from pixel to pixel
    uint ismTileSize;  // texels along a shadow map's side
};

struct RsmInterpolationPush {
    uint step;
    float leastCosine;     // of the normals of a pixel and a sample that stands for it
    float mostPlaneShare;  // distance from the pixel's plane, in pixel depths
};

#ifdef __cplusplus
}  // namespace ag::io
#endif
#endif
