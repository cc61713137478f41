#include "tools/workbench/hang_lamps.h"

#include <cmath>

#include "shaders/common/false_color.h"
#include "shaders/common/sampling.h"
#include "tools/workbench/free_space.h"

namespace ag::workbench {
namespace {

constexpr uint32_t kTriesPerLamp = 16, kMostTries = 400'000;
constexpr uint64_t kFirstId = 1'000'000;

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
             .reflects = true,
             .id = kFirstId + i});
    }
    return uint32_t(places.size());
}

}  // namespace ag::workbench
