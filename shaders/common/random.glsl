// Random numbers one after another.
#ifndef AG_RANDOM_GLSL
#define AG_RANDOM_GLSL

#include "common/sampling.h"

// In [0, 1).
float next(inout uint random) {
    random = hashUint(random);
    return unitOf(random);
}
#endif
