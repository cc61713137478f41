#pragma once

#include "engine/core/image.h"

namespace ag::reference {

// Of the red values.
inline double meanOf(const Image& image) {
    double sum = 0;
    for (const glm::vec3& p : image.pixels)
        sum += double(p.x);
    return sum / double(image.pixels.size());
}

}  // namespace ag::reference
