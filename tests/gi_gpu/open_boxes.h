// Many small things in a large hall: points of later bounces are 65 cm apart in it.
#pragma once

#include "tools/scenegen/builder.h"

namespace ag::gi {

// A grey hall, and sixty open boxes of 30 cm side by side on its floor.
inline void addHallOfOpenBoxes(scenegen::SceneBuilder& s) {
    constexpr float kSide = 0.3f;
    const glm::vec3 x(kSide, 0, 0), y(0, kSide, 0), z(0, 0, kSide);
    const uint32_t grey = s.material("grey", glm::vec3(0.6f)), white = s.material("white", glm::vec3(0.8f));
    s.materialAt(white).doubleSided = true;
    s.room("hall", {-12, 0, -12}, {12, 6, 12}, {grey, grey, grey, grey, grey, grey});
    for (int i = 0; i < 60; ++i) {
        const glm::vec3 c(-2.8f + 0.62f * float(i % 10), 0.05f, -2 + 0.7f * float(i / 10));
        s.quad("bottom", c, x, z, white);
        for (const glm::vec3 side : {glm::vec3(0), z})
            s.quad("side", c + side, x, y, white);
        for (const glm::vec3 side : {glm::vec3(0), x})
            s.quad("side", c + side, z, y, white);
    }
}

}  // namespace ag::gi
