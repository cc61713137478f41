#include "tests/play/stage/reference_light.h"

#include <algorithm>
#include <cmath>

#include "tools/reference/path_tracer.h"

namespace ag::game {
namespace {

constexpr uint32_t kDirections = 128;

// A small plane in each of many directions, evenly over the sphere.
reference::FirstHits planesAround(glm::vec3 point) {
    reference::FirstHits hits({kDirections, 1});
    for (uint32_t i = 0; i < kDirections; ++i) {
        const float z = 1 - (2 * float(i) + 1) / kDirections, r = std::sqrt(1 - z * z),
                    phi = 2.3999632f * float(i);
        reference::Surface& s = hits.surfaces[i];
        s.position = point;
        s.normal = s.geometricNormal = {r * std::cos(phi), z, r * std::sin(phi)};
        s.distance = 1;
        s.resolved = true;
        s.albedo = glm::vec3(1);
        hits.directions[i] = -s.normal;
    }
    return hits;
}

// A quarter of what falls on a plane that faces the light.
glm::vec3 directFrom(const reference::RayScene& rays, const reference::PreparedLight& p, glm::vec3 point) {
    const glm::vec3 d = p.light.position - point;
    const float distance = glm::length(d), cone = -glm::dot(d, p.light.direction) / distance;
    if (!rays.visible(point, d / distance, distance)) return glm::vec3(0);
    const float t = p.light.kind == LightKind::kSpot
                        ? glm::clamp((cone - p.cosOuter) / (p.cosInner - p.cosOuter), 0.0f, 1.0f)
                        : 1.0f;
    return p.light.intensity * (t * t / (4 * distance * distance));
}

}  // namespace

std::vector<LitFlower> litFlowers(Stage& stage, std::span<const Input> inputs) {
    std::vector<LitFlower> lit(stage.flowers.size());
    for (const Input& input : inputs) {
        stage.tick(input);
        if (stage.ticks % stage.perFrame) continue;  // no picture of it
        for (size_t i = 0; i < lit.size(); ++i) {
            if (!lit[i].scene.instances.empty() || !stage.flower(i).bloomed) continue;
            lit[i].scene = stage.game.scene();
            lit[i].probe = *std::ranges::find(lit[i].scene.probes, stage.flowers[i].bits(), &RenderProbe::id);
            lit[i].amount = stage.flower(i).amount;
        }
    }
    std::erase_if(lit, [](const LitFlower& l) { return l.scene.instances.empty(); });
    return lit;
}

gi::ProbeReading measureLight(render::Renderer& renderer, const LitFlower& lit,
                              const render::RenderSettings& settings, uint32_t frames) {
    RenderScene scene = lit.scene;
    scene.allInstancesChanged = true;
    gi::ProbeReading light;
    for (uint32_t i = 0; i < frames; ++i) {
        renderer.render(scene, {64, 36}, settings, {.timing = TimingMode::kOff},
                        [](GraphScope scope, const render::SceneView&, const render::RenderFrame& frame) {
                            scope.output(frame.outputs.display);
                        });
        scene.allInstancesChanged = false;
        scene.changedInstances.clear();
        if (const auto known = renderer.probeReadings().of(lit.probe.id)) light = *known;
    }
    return light;
}

gi::ProbeReading referenceLight(const LitFlower& lit, uint32_t bounces, bool unshadowed, uint32_t paths) {
    RenderScene bouncing = lit.scene;  // the other lights are not asked for
    std::erase_if(bouncing.lights, [](const RenderLight& light) { return !light.bounces; });
    const reference::RayScene rays(bouncing);
    JobRunner runner(2);
    const reference::FirstHits hits = planesAround(lit.probe.position);
    reference::LightSums sums(hits.size, bounces);
    reference::addPaths(rays, hits, {.bounces = bounces, .unshadowed = unshadowed},
                        {.seed = 3, .count = paths}, runner, sums);
    gi::ProbeReading mean;
    // Flames shine through area lights, as bounced light does.
    for (const auto* light : {bounces > 1 ? &sums.indirect : &sums.bounces[1], &sums.emissive})
        for (const glm::vec3& e : light->pixels)
            mean.bounced += e / float(paths * kDirections);
    for (const reference::PreparedLight& light : rays.lights())
        mean.direct += directFrom(rays, light, lit.probe.position);
    return mean;
}

}  // namespace ag::game
