#include <fmt/format.h>

#include <cmath>

#include "tools/scenegen/scenes.h"
#include "tools/stress/cases.h"

namespace ag::stress {
namespace {

constexpr double kSameNumbers =
    1e-3;  // relative RMSE: the renderer sees the same numbers, but for their last bits
constexpr double kOtherClusters =
    0.06;  // other last bits lead to other clusters, of equal worth: as neighbouring counts of them differ
constexpr double kHalfFloats = 2e-3;  // they round other numbers in another way

bool isRoot(const SceneNode& node) {
    return node.parent < 0;
}

SceneAsset moved(SceneAsset asset, glm::dvec3 by) {
    for (SceneNode& node : asset.nodes)
        if (isRoot(node)) node.local.translation += by;
    return asset;
}

// Light is scaled to match: the irradiance everywhere stays what it was.
SceneAsset scaled(SceneAsset asset, float by) {
    for (SceneNode& node : asset.nodes)
        if (isRoot(node)) node.local.translation *= double(by), node.local.scale *= by;
    for (SceneLight& light : asset.lights) {
        if (light.kind != LightKind::kDirectional) light.intensity *= by * by;
        light.range *= by;
    }
    for (SceneCamera& camera : asset.cameras)
        camera.near *= by;
    return asset;
}

// Clustering weighs distances per m², or per square of the renderer's unit where that is no metre.
void keepMetric(Stage& stage, float by) {
    const float perUnit = render::chooseUnits(stage.scene, 0, {}).length / by;
    stage.settings.bounce.valClustering.distanceWeight *= perUnit * perUnit;
    stage.settings.bounce.valClustering.planeWeight *= perUnit * perUnit;
}

SceneAsset lit(SceneAsset asset, float by) {
    for (SceneLight& light : asset.lights)
        light.intensity *= by;
    for (Material& material : asset.geometry.materials)
        material.emissive *= by;
    return asset;
}

// One scene per row; each against the plain scene's image, brought back to its power.
class Invariances {
  public:
    Invariances(const Bench& bench, const std::string& scene)
        : bench_(bench), scene_(scene), plain_(*scenegen::buildScene(scene, 0)) {}

    void run() {
        for (const double distance : {1e3, 1e4, 1e5, 1e6})
            row(fmt::format("{}, moved by {:g} m", scene_, distance), kSameNumbers,
                [&] { return moved(plain_, distance * glm::dvec3(1, 0.371, -0.6173)); });
        for (const float scale : {0x1p-10f, 0x1p10f, 1e-3f, 1e-2f, 1e-1f, 1e1f, 1e2f, 1e3f})
            row(
                fmt::format("{}, scaled by {:g}", scene_, scale),
                std::exp2(std::round(std::log2(scale))) == scale ? kSameNumbers : kOtherClusters,
                [&] { return scaled(plain_, scale); }, 1, [&](Stage& stage) { keepMetric(stage, scale); });
        for (const float power : {1e-6f, 1e-3f, 1e3f, 1e6f})
            row(
                fmt::format("{}, light times {:g}", scene_, power), kHalfFloats,
                [&] { return lit(plain_, power); }, power);
    }

  private:
    void row(
        const std::string& name, double limit, FunctionRef<SceneAsset()> make, float power = 1,
        Prepare prepare = [](Stage&) {}) {
        if (!bench_.wants(name)) return;
        if (!truth_) truth_ = renderStill(bench_, plain_);
        Still still = renderStill(bench_, make(), prepare);
        for (glm::vec3& p : still.image.pixels)
            p /= power;
        bench_.report({name, "relative RMSE", relativeRmse(truth_->image, still.image), limit,
                       still.fault ? still.fault : truth_->fault});
    }

    const Bench& bench_;
    std::string scene_;
    SceneAsset plain_;
    std::optional<Still> truth_;
};

}  // namespace

void runInvariances(const Bench& bench) {
    for (const std::string& scene : bench.options.scenes)
        Invariances(bench, scene).run();
}

}  // namespace ag::stress
