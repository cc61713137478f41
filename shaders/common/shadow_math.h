// Shadow tests on reversed depth: nearer to the light is greater.
#ifndef AG_SHADOW_MATH_H
#define AG_SHADOW_MATH_H

#include "common/portable.h"

AG_BEGIN

AG_FUNCTION float shadowCompare(float stored, float receiver) {
    return receiver >= stored ? 1.0f : 0.0f;
}

AG_END
#endif
