// Shadow views: squares of a depth atlas, one a cascade of a sun.
#ifndef AG_SHADOW_MAPS_IO_H
#define AG_SHADOW_MAPS_IO_H

#include "common/portable.h"

#ifdef __cplusplus
namespace ag::io {
#endif

const uint kMaxShadowViews = 16;
const uint kMaxCascades = 4;

struct ShadowView {
    mat4 clipFromWorld;  // reversed depth
    uvec2 origin;        // first texel in the atlas
    uint size;           // texels along a side
    float texelSize;     // m, of a square one as large
    float farDistance;   // m along the camera's axis this cascade reaches
};

#ifdef __cplusplus
}  // namespace ag::io
#endif
#endif
