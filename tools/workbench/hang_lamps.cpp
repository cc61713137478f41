#include "tools/workbench/hang_lamps.h"

#include <array>
#include <cmath>

#include "shaders/common/false_color.h"
#include "shaders/common/sampling.h"
#include "tools/reference/ray_scene.h"

namespace ag::workbench {
namespace {

constexpr uint32_t kTriesPerLamp = 16, kMostTries = 400'000;
constexpr uint64_t kFirstId = 1'000'000;

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

}  // namespace

uint32_t hangLamps(RenderScene& scene, uint32_t count) {
    if (scene.bounds.empty() || count == 0) return 0;
    const reference::RayScene rays(scene);
    const glm::vec3 size = scene.bounds.max - scene.bounds.min;
    const float clearance = 0.01f * glm::length(size);
    std::vector<glm::vec3> places;
    uint32_t tries = 0;
    for (; places.size() < count && tries < std::min(kTriesPerLamp * count + 1024, kMostTries); ++tries)
        if (const glm::vec3 place = placeInBounds(scene.bounds, tries); isFree(rays, place, clearance))
            places.push_back(place);
    if (places.empty()) return 0;
    const float volume = size.x * size.y * size.z * float(places.size()) / float(tries);
    const float range = std::cbrt(10 * volume / (4.18879f * float(places.size()))), strength = range / 1.8f;
    for (uint32_t i = 0; i < places.size(); ++i) {
        const glm::vec3 tint = glm::mix(glm::vec3(1), io::hueFromIndex(i), 0.6f);
        scene.lights.push_back(
            {.kind = LightKind::kPoint,
             .position = places[i],
             .intensity = tint * (0.35f + 0.5f * io::hashToUnit(2 * i)) * strength * strength,
             .range = range,
             .id = kFirstId + i});
    }
    return uint32_t(places.size());
}

}  // namespace ag::workbench
