// Solid angles and cross-sections of shadow-map texels.
#ifndef AG_RSM_MATH_H
#define AG_RSM_MATH_H

#include "common/portable.h"

AG_BEGIN

// Of a texel of a perspective face with N² texels and half-angle tangent t, in sr.
AG_FUNCTION float perspectiveTexelSolidAngle(float tanHalf, float resolution, float cosAxis) {
    float side = 2.0f * tanHalf / resolution;
    return side * side * cosAxis * cosAxis * cosAxis;
}

// Of a texel of an orthographic map `width` m across, in m².
AG_FUNCTION float orthoTexelArea(float width, float resolution) {
    float side = width / resolution;
    return side * side;
}

AG_END
#endif
