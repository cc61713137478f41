// Shadow views: squares of a depth atlas, one for a spot light, six for a point light, one a cascade of the
// sun.
#ifndef AG_SHADOW_MAPS_IO_H
#define AG_SHADOW_MAPS_IO_H

#include "common/portable.h"

#ifdef __cplusplus
namespace ag::io {
#endif

const uint kMaxShadowViews = 32;
const uint kMaxCascades = 4;

struct ShadowView {
    mat4 clipFromWorld;   // reversed depth
    uvec2 origin;         // first texel in the atlas
    uint size;            // texels along a side
    float texelSize;      // m: directional: of a square one as large; perspective: at 1 m
    float farDistance;    // m along the camera's axis this cascade reaches; 0: not a cascade
};

#ifdef __cplusplus
}  // namespace ag::io
#endif
#endif
