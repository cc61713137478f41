// A curve through a box that keeps neighbours in space near each other (Morton 1966).
#pragma once

#include <cstdint>

#include "engine/core/bounds.h"

namespace ag::gi {

// Every third bit of 30 from ten.
inline uint32_t spreadThird(uint32_t x) {
    x = (x | x << 16) & 0x030000ffu;
    x = (x | x << 8) & 0x0300f00fu;
    x = (x | x << 4) & 0x030c30c3u;
    return (x | x << 2) & 0x09249249u;
}

// Where along the curve a place in the box comes; its axes are cut into 1,024 each.
inline uint32_t mortonCode(glm::vec3 p, const Bounds& bounds) {
    const glm::vec3 size = glm::max(bounds.max - bounds.min, glm::vec3(1e-6f));
    const glm::uvec3 cell(glm::clamp((p - bounds.min) / size, 0.0f, 1.0f) * 1023.0f);
    return spreadThird(cell.x) | spreadThird(cell.y) << 1 | spreadThird(cell.z) << 2;
}

}  // namespace ag::gi
