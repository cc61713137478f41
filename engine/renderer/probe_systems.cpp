#include "engine/renderer/probe_systems.h"

namespace ag::render {

void extractProbes(View<const WorldTransform, const IrradianceProbe> probes, Res<RenderScene> scene) {
    size_t count = 0;
    bool changed = false;
    probes.each([&](Entity entity, const WorldTransform& world, const IrradianceProbe& probe) {
        RenderProbe out{
            .position = glm::vec3(world.translation - scene->originWorld) + world.linear * probe.offset,
            .id = entity.bits()};
        if (probe.normal != glm::vec3(0)) out.normal = glm::normalize(world.linear * probe.normal);
        if (count == scene->probes.size()) scene->probes.emplace_back();
        changed = changed || !(scene->probes[count] == out);
        scene->probes[count++] = out;
    });
    changed = changed || count != scene->probes.size();
    scene->probes.resize(count);
    if (changed) ++scene->probesVersion;
}

void readProbes(View<const IrradianceProbe, ProbeLight> probes, Res<const gi::ProbeReadings> readings) {
    probes.each([&](Entity entity, const IrradianceProbe&, ProbeLight& light) {
        const auto reading = readings->of(entity.bits());
        if (!reading) return false;
        if (light.measured && light.direct == reading->direct && light.bounced == reading->bounced)
            return false;
        light = {reading->direct, reading->bounced, 1};
        return true;
    });
}

}  // namespace ag::render
