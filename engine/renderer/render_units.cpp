#include "engine/renderer/render_units.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ag::render {
namespace {

constexpr float kUsualDiagonal = 8;      // of a scene, in units of length
constexpr float kDiagonalReach = 32;     // it may be so many times that, or that part of it
constexpr float kIrradianceReach = 256;  // the same of irradiance, which usually is one
constexpr float kStep = 5;               // powers of two from one unit to the next
constexpr float kRoomToMove = 1.25f;     // diagonals that a steady extent starts with
constexpr float kLeastExtent = 1e-6f;    // units, of a scene that is a point
constexpr float kLeastFilled = 0.4f;     // of it, by the diagonal
constexpr int kGenerationShift = 40;

// The unit before as long as `value` is near one in it.
float unitFor(float value, float reach, float before) {
    const bool known = value > 0 && std::isfinite(value);
    if (!known || (value >= before / reach && value <= before * reach)) return before;
    return std::exp2(kStep * std::round(std::log2(std::clamp(value, 1e-30f, 1e30f)) / kStep));
}

float strongest(glm::vec3 v) {
    return std::max({v.x, v.y, v.z});
}

// Of the strongest light a quarter of the scene away, or of what emits most, W/m².
float usualIrradiance(const RenderScene& scene, float diagonal, float emission) {
    float most = emission * std::numbers::pi_v<float>;
    for (const RenderLight& light : scene.lights) {
        float distance = diagonal / 4;
        if (light.range > 0) distance = std::min(distance, light.range);
        const float per = light.kind == LightKind::kDirectional ? 1 : distance * distance;
        if (per > 0) most = std::max(most, strongest(light.intensity) / per);
    }
    return most;
}

}  // namespace

RenderUnits chooseUnits(const RenderScene& scene, float emission, RenderUnits before) {
    if (scene.bounds.empty()) return before;
    const float diagonal = glm::length(scene.bounds.max - scene.bounds.min);
    return {unitFor(diagonal / kUsualDiagonal, kDiagonalReach, before.length),
            unitFor(usualIrradiance(scene, diagonal, emission), kIrradianceReach, before.light)};
}

float steadyExtent(const Bounds& bounds, float before) {
    if (bounds.empty()) return before;
    const float diagonal = glm::length(bounds.max - bounds.min);
    if (before > 0 && diagonal <= before && diagonal >= kLeastFilled * before) return before;
    return std::max(kRoomToMove * diagonal, kLeastExtent);
}

void inUnits(const RenderScene& scene, RenderUnits units, uint64_t generation, RenderScene& out) {
    const float perMetre = 1 / units.length, perWatt = 1 / units.light;
    out = scene;
    for (RenderInstance& instance : out.instances)
        instance.worldFromLocal *= perMetre;
    for (RenderLight& light : out.lights) {
        light.position *= perMetre;
        light.range *= perMetre;
        light.intensity *= light.kind == LightKind::kDirectional ? perWatt : perWatt * perMetre * perMetre;
    }
    for (RenderProbe& probe : out.probes)
        probe.position *= perMetre;
    if (!scene.bounds.empty()) out.bounds = {scene.bounds.min * perMetre, scene.bounds.max * perMetre};
    out.camera.clipFromWorld[3] *= perMetre;  // the view's own units shrink as the world's do
    for (int column = 0; column < 4; ++column)
        out.camera.worldFromClip[column].w *= units.length;
    out.camera.position *= perMetre;
    out.camera.near *= perMetre;
    for (uint64_t* version : {&out.instancesVersion, &out.lightsVersion, &out.probesVersion,
                              &out.cameraVersion, &out.originVersion})
        *version += generation << kGenerationShift;
}

}  // namespace ag::render
