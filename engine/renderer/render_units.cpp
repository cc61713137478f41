#include "engine/renderer/render_units.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ag::render {
namespace {

constexpr int kGenerationShift = 40;

}  // namespace

RenderUnits chooseUnits(const RenderScene& scene, float emission, RenderUnits before) {
    const float diagonal = glm::length(scene.bounds.max - scene.bounds.min);
    float most = emission * std::numbers::pi_v<float>;
    for (const RenderLight& light : scene.lights)
        most = std::max(most, gi::irradianceOf(light.intensity, light.kind == LightKind::kDirectional,
                                               light.range, diagonal));
    return gi::chooseUnits(scene.bounds, most, before);
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
