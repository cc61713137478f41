#include "tests/play/stage/reference_light.h"

#include <cmath>

#include "engine/scene/components.h"
#include "tools/reference/path_tracer.h"
#include "tools/scenegen/builder.h"

namespace ag::game {

gi::ProbeLight lightFlower(Stage& stage, size_t flower, glm::vec3 lamp, glm::vec3 target) {
    // The player would move the lamp back each tick: only frames pass here.
    stage.game.tick({});
    View<LocalTransform, const HandLamp>(stage.game.world(), {stage.game.world().version(), 0})
        .each([&](LocalTransform& local, const HandLamp&) {
            local.translation = glm::dvec3(lamp);
            local.rotation = scenegen::lookRotation(target - lamp);
        });
    gi::ProbeLight light;
    for (int i = 0; i < 24; ++i) {
        stage.game.frame(stage.size);
        stage.renderer.render(stage.game.scene(), stage.size, stage.settings, stage.options,
                              [](FrameGraph& graph, const gi::SceneView&, const gi::GiFrame& frame) {
                                  graph.output(frame.outputs.display);
                              });
        if (const auto known = stage.renderer.probeReadings().of(stage.flowers.at(flower).bits()))
            light = {known->direct, known->bounced, 1};
    }
    return light;
}

glm::vec3 referenceLight(const RenderScene& scene, glm::vec3 point) {
    constexpr int kDirections = 128;
    constexpr uint32_t kSamples = 512;
    RenderScene bouncing = scene;  // the other lights are not asked for
    std::erase_if(bouncing.lights, [](const RenderLight& light) { return !light.bounces; });
    const reference::RayScene rays(bouncing);
    JobRunner runner(2);
    reference::FirstHits hits({kDirections, 1});
    for (int i = 0; i < kDirections; ++i) {
        const float z = 1 - (2 * float(i) + 1) / kDirections, r = std::sqrt(1 - z * z),
                    phi = 2.3999632f * float(i);
        reference::Surface& s = hits.surfaces[size_t(i)];
        s.position = point;
        s.normal = s.geometricNormal = {r * std::cos(phi), z, r * std::sin(phi)};
        s.distance = 1;
        s.resolved = true;
        s.albedo = glm::vec3(1);
        hits.directions[size_t(i)] = -s.normal;
    }
    reference::LightSums sums(hits.size, 1);
    uint64_t count = 0;
    reference::addPaths(rays, hits, {.bounces = 1}, {}, 3, 0, kSamples, runner, sums, count);
    glm::vec3 mean(0);
    for (const glm::vec3& e : sums.bounces[1].pixels)
        mean += e / float(kSamples * kDirections);
    return mean;
}

}  // namespace ag::game
