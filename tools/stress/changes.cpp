#include <algorithm>
#include <chrono>
#include <random>

#include <fmt/format.h>

#include "engine/core/hash.h"
#include "engine/core/process_memory.h"
#include "tools/scenegen/scenes.h"
#include "tools/stress/cases.h"

namespace ag::stress {
namespace {

using Clock = std::chrono::steady_clock;

SceneAsset hall() {
    return *scenegen::buildScene("hall", 0);
}

CameraPose randomPose(std::mt19937& random) {
    std::uniform_real_distribution<float> unit(-1, 1);
    CameraPose pose;
    pose.position = {4.5 * unit(random), 1.6 + unit(random), 3.0 * unit(random)};
    pose.forward = glm::normalize(glm::vec3(unit(random), 0.3f * unit(random), unit(random) + 1e-3f));
    return pose;
}

// Something changes in every frame, then nothing for as long as a still image takes: it must become that
// image.
void settles(const Bench& bench, std::optional<Still>& truth, const std::string& name, double limit,
             FunctionRef<void(Stage&, uint32_t, bool)> change) {
    if (!bench.wants(name)) return;
    constexpr uint32_t kChanges = 24;
    if (!truth) truth = renderStill(bench, hall());
    Stage stage(bench.device, hall(), kSize, bench.options.mapResolution);
    std::optional<std::string> fault = truth->fault;
    for (uint32_t i = 0; i < kChanges; ++i) {
        change(stage, i, i + 1 == kChanges);
        stage.frame();
        if (!fault) fault = stage.fault();
    }
    stage.frames(std::max(bench.options.frames, stage.settings.bounce.valClustering.settleFrames + 8));
    if (!fault) fault = stage.fault();
    bench.report(
        {name, "relative RMSE once it rests", relativeRmse(truth->image, stage.radiance()), limit, fault});
}

// One step of everything that may move.
void disturb(Stage& stage, uint32_t frame, std::mt19937& random) {
    std::uniform_real_distribution<float> unit(-1, 1);
    if (frame % 97 == 0) setCamera(stage.scene, randomPose(random), stage.size);  // a cut
    RenderLight& light = stage.scene.lights[frame % stage.scene.lights.size()];
    light.direction =
        glm::normalize(light.direction + 0.2f * glm::vec3(unit(random), unit(random), unit(random)));
    if (frame % 31 == 0) light.intensity = glm::vec3(std::exp(3 * unit(random)) * 40);
    if (frame % 53 == 0) light.intensity = glm::vec3(0);
    ++stage.scene.lightsVersion;
    RenderInstance& box = stage.scene.instances[stage.scene.instances.size() - 1 - frame % 3];
    box.worldFromLocal[3] =
        glm::clamp(box.worldFromLocal[3] + 0.05f * glm::vec3(unit(random), unit(random), unit(random)),
                   stage.place({-5, 0.5, -3}), stage.place({5, 3.5, 3}));
    ++stage.scene.instancesVersion;
}

double quantile(std::vector<double> values, double q) {
    if (values.empty()) return 0;
    const auto nth = values.begin() + std::ptrdiff_t(q * double(values.size() - 1));
    std::nth_element(values.begin(), nth, values.end());
    return *nth;
}

struct Motion {
    std::optional<std::string> fault;
    std::vector<double> frameMs;
    double residentBefore = 0, residentAfter = 0;  // MiB
    uint64_t deviceBefore = 0, deviceAfter = 0;    // bytes
    uint64_t bits = 0;                             // hash of all images looked at
};

Motion moveAtRandom(const Bench& bench, uint32_t frames, bool skip) {
    Stage stage(bench.device, hall(), kSize, bench.options.mapResolution);
    stage.options.skip = skip;
    std::mt19937 random(20);
    Motion m;
    const uint32_t warm = frames / 2;  // pipelines are compiled when first used
    for (uint32_t i = 0; i < frames && !m.fault; ++i) {
        disturb(stage, i, random);
        const auto begin = Clock::now();
        stage.frame();
        m.frameMs.push_back(std::chrono::duration<double, std::milli>(Clock::now() - begin).count());
        if (i % 16 == 0) {
            m.fault = stage.fault();
            const Image image = stage.radiance();
            m.bits = hashBytes(std::as_bytes(std::span(image.pixels)), m.bits);
            if (m.fault) m.fault = fmt::format("frame {}: {}", i, *m.fault);
        }
        if (i == warm) {
            m.residentBefore = residentMib();
            m.deviceBefore = bench.device.memory().liveBytes();
        }
    }
    m.residentAfter = residentMib();
    m.deviceAfter = bench.device.memory().liveBytes();
    return m;
}

}  // namespace

void runChanges(const Bench& bench) {
    std::mt19937 random(4);
    std::optional<Still> truth;
    settles(bench, truth, "resized every frame", 0.03, [&](Stage& s, uint32_t i, bool last) {
        s.size = last ? kSize : glm::uvec2(1 + (37 * i) % 300, 1 + (53 * i) % 200);
        setCamera(s.scene, cameraOf(s.asset, 0), s.size);
    });
    const glm::vec3 on = hall().lights[0].intensity;
    settles(bench, truth, "light toggled every frame", 0.03, [&](Stage& s, uint32_t i, bool last) {
        s.scene.lights[0].intensity = last || i % 2 ? on : glm::vec3(0);
        ++s.scene.lightsVersion;
    });
    settles(bench, truth, "camera cut every frame", 0.03, [&](Stage& s, uint32_t, bool last) {
        setCamera(s.scene, last ? cameraOf(s.asset, 0) : randomPose(random), s.size);
    });
}

void runRandomMotion(const Bench& bench) {
    const uint32_t frames = bench.options.movingFrames;
    const std::string name = fmt::format("random motion, {} frames", frames);
    if (bench.wants(name)) {
        const Motion m = moveAtRandom(bench, frames, true);
        bench.report({name, "MiB grown in its second half",
                      std::max(m.residentAfter - m.residentBefore,
                               (double(m.deviceAfter) - double(m.deviceBefore)) / 1048576.0),
                      bench.options.mostGrowth, m.fault,
                      fmt::format("frame median {:.1f} ms, p99 {:.1f} ms", quantile(m.frameMs, 0.5),
                                  quantile(m.frameMs, 0.99))});
    }
    const std::string skipping = "skipping in random motion";
    if (!bench.wants(skipping)) return;
    const uint32_t few = std::min(frames / 2, 320u);
    const Motion with = moveAtRandom(bench, few, true), without = moveAtRandom(bench, few, false);
    bench.report({skipping, "images that differ", with.bits == without.bits ? 0.0 : 1.0, 0,
                  with.fault ? with.fault : without.fault});
}

}  // namespace ag::stress
