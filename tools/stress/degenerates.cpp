#include <fmt/format.h>

#include "tools/scenegen/builder.h"
#include "tools/scenegen/scenes.h"
#include "tools/stress/cases.h"

namespace ag::stress {
namespace {

RenderLight pointLight(glm::vec3 position, float intensity) {
    return {.kind = LightKind::kPoint,
            .position = position,
            .intensity = glm::vec3(intensity),
            .bounces = true,
            .id = 1};
}

// A patch one texel of an RSM wide, and a wall that its light falls on.
SceneAsset patch(float side) {
    scenegen::SceneBuilder b("patch");
    const uint32_t gray = b.material("gray", glm::vec3(0.5f));
    b.quad("patch", {-side / 2, 0, -side / 2}, {0, 0, side}, {side, 0, 0}, gray);
    b.quad("wall", {-1, 0, -0.5f}, {2, 0, 0}, {0, 1, 0}, gray);
    b.spot("lamp", {0.0156f, 2, 0.0156f}, {0, -1, 0}, glm::vec3(100), {10, 14});
    b.camera("camera", {0, 0.6f, 2}, {0, 0.3f, -0.5f}, 50);
    return b.finish();
}

// A strip so narrow that all clusters lie on one line.
SceneAsset strip() {
    scenegen::SceneBuilder b("strip");
    const uint32_t gray = b.material("gray", glm::vec3(0.5f));
    b.quad("strip", {-2, 0, -0.01f}, {0, 0, 0.02f}, {4, 0, 0}, gray);
    b.quad("wall", {-2, 0, -0.5f}, {4, 0, 0}, {0, 1, 0}, gray);
    b.sun("sun", {0, -1, 0}, glm::vec3(4));
    b.camera("camera", {0, 0.7f, 3}, {0, 0.3f, -0.5f}, 50);
    return b.finish();
}

class Degenerates {
  public:
    explicit Degenerates(const Bench& bench) : bench_(bench) {}

    // The mean of the image over that of another technique on the same scene, off 1.
    void againstTexels(const std::string& name, const SceneAsset& asset, Prepare prepare, double limit) {
        if (!bench_.wants(name)) return;
        const auto bounceOnly = [&](Stage& stage) {
            prepare(stage);
            stage.settings.bounce.ismAtlas.enabled = false;
        };
        const Still still = renderStill(bench_, asset, bounceOnly);
        const Still truth = renderStill(bench_, asset, [&](Stage& stage) {
            bounceOnly(stage);
            stage.settings.technique = render::Technique::kRsmBrute;
        });
        bench_.report({name, "mean against every texel, off 1",
                       std::abs(meanRadiance(still.image) / meanRadiance(truth.image) - 1), limit,
                       still.fault ? still.fault : truth.fault});
    }

    // Mean radiance over that of `truth`.
    void share(const std::string& name, const SceneAsset& asset, Prepare prepare, Prepare whole,
               double limit) {
        if (!bench_.wants(name)) return;
        const Still still = renderStill(bench_, asset, prepare);
        const Still truth = renderStill(bench_, asset, whole);
        bench_.report({name, "mean radiance over that outside",
                       meanRadiance(still.image) / meanRadiance(truth.image), limit, still.fault});
    }

    void finite(const std::string& name, const SceneAsset& asset, Prepare prepare) {
        if (!bench_.wants(name)) return;
        const Still still = renderStill(bench_, asset, prepare);
        bench_.report({name, "faults", still.fault ? 1.0 : 0.0, 0, still.fault});
    }

    void dark(const std::string& name, const SceneAsset& asset, Prepare prepare) {
        if (!bench_.wants(name)) return;
        const Still still = renderStill(bench_, asset, prepare);
        bench_.report({name, "mean radiance", meanRadiance(still.image), 0, still.fault});
    }

    void oneLitTexel() {
        const std::string name = "one lit texel";
        if (!bench_.wants(name)) return;
        uint32_t lit = 0;
        const Still still = renderStill(bench_, patch(0.02f), [&](Stage& stage) {
            stage.settings.bounce.rsm.resolution = 32;
            stage.frame();
            lit = stage.litTexels();
        });
        bench_.report({name, "lit texels, off 1", std::abs(double(lit) - 1), 0, still.fault});
    }

  private:
    const Bench& bench_;
};

}  // namespace

void runDegenerates(const Bench& bench) {
    Degenerates d(bench);
    for (const float gap : {0.0f, 1e-6f, 1e-3f})  // above the short block
        d.finite(fmt::format("receiver {:g} m from a light", gap), cornell(), [&](Stage& s) {
            s.scene.lights = {pointLight(s.place({0.35f, 0.6f + gap, 0.35f}), 10)};
        });
    const Prepare inside = [](Stage& s) { s.scene.lights = {pointLight(s.place({-0.35, 0.6, -0.3}), 10)}; };
    const Prepare outside = [](Stage& s) { s.scene.lights = {pointLight(s.place({0.1, 0.6, 0.2}), 10)}; };
    d.share("light inside a wall", cornell(), inside, outside, 1e-3);
    if (bench.options.twice) {
        SceneAsset lantern = cornell();
        for (Material& m : lantern.geometry.materials)
            m.doubleSided = true;
        // Walls without thickness leak (docs/reliability.md): no more than they do.
        d.share("light inside a double-sided box", lantern, inside, outside, 0.05);
    }
    d.againstTexels(
        "more clusters than lit texels", cornell(),
        [](Stage& s) {
            s.settings.bounce.valClustering.count = io::kMaxClusters;
            s.settings.bounce.rsm.resolution = 32;
        },
        0.03);
    d.againstTexels(
        "one cluster", cornell(), [](Stage& s) { s.settings.bounce.valClustering.count = 1; }, 0.5);
    d.oneLitTexel();
    d.againstTexels(
        "one lit texel's light", patch(0.02f), [](Stage& s) { s.settings.bounce.rsm.resolution = 32; }, 0.03);
    d.againstTexels(
        "collinear clusters", strip(), [](Stage&) {}, 0.05);
    SceneAsset black = cornell();
    for (Material& m : black.geometry.materials)
        m.baseColor = {0, 0, 0, 1};
    d.dark("black albedo", black, [](Stage&) {});
    d.dark("light without power", cornell(), [](Stage& s) { s.scene.lights[0].intensity = glm::vec3(0); });
    d.finite("no importance: nothing lit faces the view", cornell(), [](Stage& s) {
        s.settings.bounce.importance.viewWeight = 1;
        setCamera(s.scene, {.position = {0, 1, 4}, .forward = {0, 0, 1}}, s.size);
    });
    d.finite("window of one pixel", cornell(), [](Stage& s) {
        s.size = glm::uvec2(1);
        setCamera(s.scene, cameraOf(s.asset, 0), s.size);
    });
}

}  // namespace ag::stress
