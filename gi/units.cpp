#include "gi/units.h"

#include <algorithm>
#include <cmath>

namespace ag::gi {
namespace {

constexpr float kUsualDiagonal = 8;      // of a scene, in units of length
constexpr float kDiagonalReach = 32;     // it may be so many times that, or that part of it
constexpr float kIrradianceReach = 256;  // the same of irradiance, which usually is one
constexpr float kStep = 5;               // powers of two from one unit to the next
constexpr float kRoomToMove = 1.25f;     // diagonals that a steady extent starts with
constexpr float kLeastExtent = 1e-6f;    // units, of a scene that is a point
constexpr float kLeastFilled = 0.4f;     // of it, by the diagonal

// The unit before as long as `value` is near one in it.
float unitFor(float value, float reach, float before) {
    const bool known = value > 0 && std::isfinite(value);
    if (!known || (value >= before / reach && value <= before * reach)) return before;
    return std::exp2(kStep * std::round(std::log2(std::clamp(value, 1e-30f, 1e30f)) / kStep));
}

float strongest(glm::vec3 v) {
    return std::max({v.x, v.y, v.z});
}

}  // namespace

float irradianceOf(glm::vec3 intensity, bool directional, float range, float diagonal) {
    const float distance = range > 0 ? std::min(diagonal / 4, range) : diagonal / 4;
    const float per = directional ? 1 : distance * distance;
    return per > 0 ? strongest(intensity) / per : 0;
}

RenderUnits chooseUnits(const Bounds& bounds, float irradiance, RenderUnits before) {
    if (bounds.empty()) return before;
    const float diagonal = glm::length(bounds.max - bounds.min);
    return {unitFor(diagonal / kUsualDiagonal, kDiagonalReach, before.length),
            unitFor(irradiance, kIrradianceReach, before.light)};
}

float steadyExtent(const Bounds& bounds, float before) {
    if (bounds.empty()) return before;
    const float diagonal = glm::length(bounds.max - bounds.min);
    if (before > 0 && diagonal <= before && diagonal >= kLeastFilled * before) return before;
    return std::max(kRoomToMove * diagonal, kLeastExtent);
}

float rayOffset(const Bounds& bounds, float extent) {
    constexpr float kSmallScenes = 2e-5f, kLargeScenes = 4e-6f;  // of the extent
    constexpr float kBetween = 4e-4f;                            // units, of scenes of 20 to 100
    constexpr float kRounding = 2.5e-7f;  // of a coordinate: a few of a float's last digits
    const float offset = std::max(kLargeScenes * extent, std::min(kSmallScenes * extent, kBetween));
    if (bounds.empty()) return offset;
    const glm::vec3 farthest = glm::max(glm::abs(bounds.min), glm::abs(bounds.max));
    // In steps, so that it stays while things move at the scene's edge.
    const float steady = std::exp2(std::ceil(std::log2(std::max(glm::length(farthest), extent))));
    return std::max(offset, kRounding * steady);
}

}  // namespace ag::gi
