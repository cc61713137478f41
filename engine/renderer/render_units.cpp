#include "engine/renderer/render_units.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ag::render {
namespace {

constexpr int kGenerationShift = 40;

uint64_t shifted(uint64_t generation) {
    return generation << kGenerationShift;
}

// Only rows that differ from those of the version that `out` is of.
void takeInstances(const RenderScene& scene, float perMetre, uint64_t generation, RenderScene& out) {
    const uint64_t version = scene.instancesVersion + shifted(generation);
    const bool known = out.geometry == scene.geometry && out.instances.size() <= scene.instances.size();
    const auto take = [&](uint32_t begin, uint32_t end) {
        for (uint32_t i = begin; i < end; ++i) {
            out.instances[i] = scene.instances[i];
            out.instances[i].worldFromLocal *= perMetre;
        }
    };
    if (known && out.instancesVersion == version) return;
    const bool all = !known || scene.allInstancesChanged || out.instancesVersion + 1 != version;
    out.instances.resize(scene.instances.size());
    if (all) return take(0, uint32_t(scene.instances.size()));
    for (const RenderScene::Range& range : scene.changedInstances)
        take(range.begin, range.end);
}

// All but the instances.
void takeTheRest(const RenderScene& scene, RenderScene& out) {
    out.geometry = scene.geometry;
    out.originWorld = scene.originWorld;
    out.skinnedMeshes = scene.skinnedMeshes;
    out.joints = scene.joints;
    out.lights = scene.lights;
    out.sky = scene.sky;
    out.probes = scene.probes;
    out.camera = scene.camera;
    out.bounds = scene.bounds;
    out.instancesVersion = scene.instancesVersion;
    out.lightsVersion = scene.lightsVersion;
    out.probesVersion = scene.probesVersion;
    out.cameraVersion = scene.cameraVersion;
    out.originVersion = scene.originVersion;
    out.changedInstances = scene.changedInstances;
    out.replacedInstances = scene.replacedInstances;
    out.allInstancesChanged = scene.allInstancesChanged;
}

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
    takeInstances(scene, perMetre, generation, out);
    takeTheRest(scene, out);
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
        *version += shifted(generation);
}

}  // namespace ag::render
