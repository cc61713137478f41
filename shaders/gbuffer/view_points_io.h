// Surface points that stand for what the camera sees.
#ifndef AG_VIEW_POINTS_IO_H
#define AG_VIEW_POINTS_IO_H

#include "common/portable.h"

#ifdef __cplusplus
namespace ag::io {
#endif

const uint kViewPointCount = 1024;

struct ViewPoint {  // 2 vec4
    vec3 position;
    float weight;  // 1, or 0 where the pixel shows no surface
    vec3 normal;
    float depth;  // reversed depth of the pixel, 0: sky
};

#ifdef __cplusplus
}  // namespace ag::io
#endif
#endif
