// The first bounce corrected by rays: walls that maps leak through are dark, and what moves is where it moved
// to.
#include "tests/gi_gpu/bench.h"
#include "tools/scenegen/scenes.h"

namespace ag::gi {
namespace {

Image bounce1After(Bench& b, int frames) {
    for (int i = 0; i < frames; ++i)
        b.frame();
    return readImage(b.renderer, b.last.bounce.bounce1.image);
}

TEST(TexelRays, WallsLitFromOutsideSendNothingInside) {
    std::array<double, 2> mean{};
    for (const bool rays : {false, true}) {
        Bench b(*scenegen::buildScene("shell", 0), {96, 54});
        b.settings.bounce.texelRays.enabled = rays;
        mean[rays] = meanOf(bounce1After(b, 40));
    }
    const double truth = 0.00679;  // W/m², by path tracing: the lamp's
    std::printf("over the truth: %.4f, with rays %.4f\n", mean[0] / truth, mean[1] / truth);
    EXPECT_NEAR(mean[1] / truth, 1, 0.1);
    EXPECT_LT(mean[0] / truth, 6) << "domes send nothing inside, however wide the pixels";
}

TEST(TexelRays, WhatMovedStandsInTheWayWhereItIs) {
    const SceneAsset asset = *scenegen::buildScene("occluder", 0);
    const auto at = [&](Bench& b, float aside) {
        for (RenderInstance& instance : b.scene.instances) {
            instance.movable = true;
            instance.worldFromLocal[3].x += aside;
        }
        b.scene.allInstancesChanged = true;
        ++b.scene.instancesVersion;
    };
    Bench moved(asset, {96, 54}), fresh(asset, {96, 54}), before(asset, {96, 54});
    for (Bench* b : {&moved, &fresh, &before})
        b->settings.bounce.texelRays.enabled = true;
    at(moved, 0), at(before, 0), at(fresh, 0.5f);
    bounce1After(moved, 8);
    at(moved, 0.5f);
    const Image truth = bounce1After(fresh, 64), image = bounce1After(moved, 64);
    const Image old = bounce1After(before, 64);
    const double mean = meanOf(truth);
    EXPECT_LT(shareOff(image, truth, 0.25 * mean), 0.03);
    EXPECT_GT(shareOff(old, truth, 0.25 * mean), 0.06);  // it makes a difference
}

}  // namespace
}  // namespace ag::gi
