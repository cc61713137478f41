#include "tools/workbench/free_space.h"

#include <array>

namespace ag::workbench {
namespace {

// The axes and the diagonals of a cube.
constexpr std::array<glm::vec3, 14> kAbout = {{{1, 0, 0},
                                               {-1, 0, 0},
                                               {0, 1, 0},
                                               {0, -1, 0},
                                               {0, 0, 1},
                                               {0, 0, -1},
                                               {1, 1, 1},
                                               {1, 1, -1},
                                               {1, -1, 1},
                                               {1, -1, -1},
                                               {-1, 1, 1},
                                               {-1, 1, -1},
                                               {-1, -1, 1},
                                               {-1, -1, -1}}};

}  // namespace

// Under the open sky a few rays may meet nothing; those from inside a wall meet it from behind.
bool isFree(const reference::RayScene& rays, glm::vec3 place, float clearance) {
    int met = 0;
    for (const glm::vec3 d : kAbout) {
        reference::Surface surface;
        if (!rays.intersect(place, glm::normalize(d), surface)) continue;
        if (surface.hidden || surface.distance < clearance) return false;
        ++met;
    }
    reference::Surface floor;
    return met >= 8 && rays.intersect(place, {0, -1, 0}, floor);
}

// An even sequence in the box: multiples of the inverse powers of the root of x⁴ = x + 1 (Roberts 2018).
glm::vec3 placeInBounds(const Bounds& b, uint32_t i) {
    const glm::dvec3 at = glm::fract(double(i + 1) * glm::dvec3(0.8191725134, 0.6710436067, 0.5497004779));
    return b.min + (b.max - b.min) * glm::vec3(at);
}

}  // namespace ag::workbench
