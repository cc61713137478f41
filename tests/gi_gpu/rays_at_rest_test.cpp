// What rays add to a picture that stands still, term by term against path tracing.
#include "engine/core/image_difference.h"
#include "tests/gi_gpu/bench.h"
#include "tests/gi_gpu/open_boxes.h"
#include "tools/reference/reference.h"
#include "tools/scenegen/builder.h"
#include "tools/scenegen/scenes.h"

namespace ag::gi {
using namespace render;
namespace {

Image traced(const Bench& b, Layer layer, uint32_t bounces, uint32_t samples) {
    const reference::RayScene rays(b.scene);
    JobRunner runner(2);
    const std::string name(layerInfo(layer).name);
    const reference::Reference all = reference::makeReference(
        rays, b.size, {.paths = {.bounces = bounces}, .samplesPerPixel = samples, .layer = name}, runner,
        [](double) {});
    return *reference::layerOf(all, name);
}

Image atRest(Bench& b, Layer layer, uint32_t frames) {
    return renderLayer(b.renderer, b.scene, b.size, settingsOf(layer, b.settings), layer, frames);
}

double errorOf(const Image& image, const Image& truth) {
    return compareImages(truth, image)->relativeRmse;
}

// Error of direct light by rays over that by maps.
double raysOverMaps(const char* scene) {
    Bench b(*scenegen::buildScene(scene, 0), {96, 54});
    const Image truth = traced(b, Layer::kDirect, 0, 2);
    const double rays = errorOf(atRest(b, Layer::kDirect, 6), truth);
    b.settings.shadowMaps.rays = false;
    const double maps = errorOf(atRest(b, Layer::kDirect, 6), truth);
    std::printf("%s, direct: relative RMSE %.4f, by maps %.4f\n", scene, rays, maps);
    return rays / maps;
}

TEST(RaysAtRest, SunsShadowsAreAsTraced) {
    EXPECT_LT(raysOverMaps("courtyard"), 0.5);
}

TEST(RaysAtRest, EdgesOfLampsShadowsAreAsTraced) {
    EXPECT_LT(raysOverMaps("cornell"), 0.5);
}

// A lattice of 12 cm over a floor, cut out by its texture's alpha.
SceneAsset underALattice(bool lamp) {
    scenegen::SceneBuilder s("lattice");
    const uint32_t white = s.material("white", glm::vec3(0.5f)),
                   lattice = s.material("lattice", glm::vec3(0.5f));
    s.quad("floor", {-4, 0, -4}, {0, 0, 8}, {8, 0, 0}, white);
    s.quad("lattice", {-4, 1, -4}, {0, 0, 8}, {8, 0, 0}, lattice);
    if (lamp)
        s.point("lamp", {0.3f, 4, 0.2f}, glm::vec3(20));
    else
        s.sun("sun", {0.2f, -1, 0.3f}, glm::vec3(5));
    s.camera("camera", {0, 0.9f, 2}, {0, 0, 0}, 60);
    SceneAsset asset = s.finish();
    cutOut(
        asset, lattice, [](uint32_t x, uint32_t y) { return x % 8 < 4 && y % 8 < 4; },
        [](glm::vec3 p) { return glm::vec2(p.x + 4, p.z + 4) / 8.0f; });
    return asset;
}

TEST(RaysAtRest, ShadowsOfMaskedSurfacesHaveTheirHoles) {
    for (const bool lamp : {false, true}) {
        Bench b(underALattice(lamp), {96, 54});
        const Image truth = traced(b, Layer::kDirect, 0, 1);
        const Image rays = atRest(b, Layer::kDirect, 6);
        b.settings.shadowMaps.rays = false;
        const Image maps = atRest(b, Layer::kDirect, 6);
        const double mean = meanOf(truth), off = shareOff(rays, truth, 0.1 * mean),
                     offByMaps = shareOff(maps, truth, 0.1 * mean);
        std::printf("through a lattice, %s: %.2f %% of the pixels are off, %.2f %% by maps\n",
                    lamp ? "lamp" : "sun", 100 * off, 100 * offByMaps);
        EXPECT_GT(mean, 0.1);
        EXPECT_LT(off, 0.01);
        EXPECT_GT(offByMaps, 0.05);
    }
}

// Light of the sky ends at edges and in creases that neighbours do not know of.
TEST(RaysAtRest, EachPixelFindsTheSkyByItself) {
    Bench b(*scenegen::buildScene("courtyard", 0), {96, 54});
    const Image truth = traced(b, Layer::kSky, 0, 512);
    b.settings.bounce.sky.settleFrames = 64;
    const double turns = errorOf(atRest(b, Layer::kSky, 4 * 64 + 4), truth);
    b.settings.bounce.sky.allPixels = false;
    const double one = errorOf(atRest(b, Layer::kSky, 4 * 64 + 4), truth);
    std::printf("courtyard, sky: relative RMSE %.4f, of every fourth pixel %.4f\n", turns, one);
    EXPECT_LT(turns, 0.7 * one);
}

// Tubes of 6 cm on walls: points on them, far from each other, leave blots.
TEST(RaysAtRest, WhatIsNearAnEmissiveSurfaceIsLitByAllOfIt) {
    Bench b(*scenegen::buildScene("neon", 0), {96, 54});
    const Image truth = traced(b, Layer::kEmissive, 0, 512);
    const auto error = [&](float reach) {
        b.settings.bounce.texelRays = {.reach = reach, .settleFrames = 64};
        return errorOf(atRest(b, Layer::kEmissive, framesToRest(b.settings.bounce)), truth);
    };
    const double near = error(0.05f), points = error(0);
    std::printf("neon: relative RMSE %.3f, by points alone %.3f\n", near, points);
    EXPECT_LT(near, 0.8 * points);
}

// The renderer counts such light in units of its own.
TEST(RaysAtRest, SurfacesMayShineHoweverBright) {
    constexpr float kTimes = 1e6f;
    std::array<double, 2> mean{};
    for (const bool bright : {false, true}) {
        SceneAsset asset = *scenegen::buildScene("neon", 0);
        for (Material& m : asset.geometry.materials)
            m.emissive *= bright ? kTimes : 1;
        Bench b(std::move(asset), {96, 54});
        b.settings.bounce.texelRays = {.reach = 1};
        mean[bright] = meanOf(atRest(b, Layer::kEmissive, 64));
    }
    EXPECT_NEAR(mean[1] / mean[0] / double(kTimes), 1, 0.01);
}

TEST(RaysAtRest, LaterBouncesLoseLittleLight) {
    Bench b(*scenegen::buildScene("courtyard", 0), {80, 45});
    b.settings = {};
    useSmallMaps(b.settings);
    addBounces(b.settings);
    b.settings.bounce.texelRays = {.settleFrames = 32};
    b.settings.bounce.sky.settleFrames = b.settings.bounce.laterBounces.settleFrames = 32;
    const double truth = meanOf(traced(b, Layer::kIndirect, 16, 64));
    const auto ratio = [&](uint32_t rays) {
        b.settings.bounce.laterBounces.rays = rays;
        return meanOf(atRest(b, Layer::kIndirect, framesToRest(b.settings.bounce))) / truth;
    };
    const double with = ratio(4), without = ratio(0);
    std::printf("courtyard, all bounces: mean ratio %.3f, %.3f without rays of points\n", with, without);
    b.settings.bounce.texelRays.reach = 0;  // nothing is met near pixels
    const double far = ratio(4);
    std::printf("%.3f where rays of pixels meet nothing near\n", far);
    EXPECT_NEAR(with, 1, 0.03);
    EXPECT_GT(without, 0.97);  // 0.925 when points of double-sided surfaces faced the front alone
    EXPECT_LT(without, 1.15);  // area lights alone have a tenth too much
    EXPECT_GT(with, far + 0.01);
}

SceneAsset boxesInAHall() {
    scenegen::SceneBuilder s("boxes");
    addHallOfOpenBoxes(s);
    s.point("lamp", {1.5f, 4, 1}, glm::vec3(60));
    s.camera("camera", {0.3f, 1.6f, 0.6f}, {0.3f, 0, -0.2f}, 69);
    return s.finish();
}

TEST(RaysAtRest, SmallThingsPassLightOnAmongEachOther) {
    Bench b(boxesInAHall(), {64, 36});
    b.settings = {};
    useSmallMaps(b.settings);
    addBounces(b.settings);
    b.settings.bounce.texelRays = {.settleFrames = 32};
    b.settings.bounce.laterBounces.settleFrames = 32;
    b.settings.bounce.sky.settleFrames = 0;
    const double truth = meanOf(traced(b, Layer::kIndirect, 16, 128));
    const double ratio = meanOf(atRest(b, Layer::kIndirect, framesToRest(b.settings.bounce))) / truth;
    std::printf("boxes: all bounces over path tracing's %.3f\n", ratio);
    EXPECT_GT(ratio, 0.9);  // 0.78 in a picture of 160x90 where rays went on from one near surface alone
    EXPECT_LT(ratio, 1.02);
}

}  // namespace
}  // namespace ag::gi
