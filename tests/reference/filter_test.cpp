// Pixel filters against closed forms, and lit points against paths alone.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "common/sampling.h"
#include "engine/scene/static_scene.h"
#include "tests/reference/mean.h"
#include "tools/reference/reference.h"
#include "tools/scenegen/builder.h"
#include "tools/scenegen/scenes.h"

namespace ag::reference {
namespace {

Reference trace(const SceneAsset& asset, glm::uvec2 size, const ReferenceSettings& settings) {
    RenderScene scene = staticScene(asset);
    setCamera(scene, cameraOf(asset, 0), size);
    const RayScene rays(scene);
    JobRunner runner(2);
    return makeReference(rays, size, settings, runner, [](double) {});
}

// A wall seen head-on that ends at a part of the middle pixel's width; a sun lights it evenly.
SceneAsset halfWall(float edge) {
    scenegen::SceneBuilder b("wall");
    b.quad("wall", {-50, -50, 0}, {50 + edge, 0, 0}, {0, 100, 0}, b.material("gray", glm::vec3(0.5f)));
    b.sun("sun", {0, 0, -1}, glm::vec3(2));
    b.camera("camera", {0, 0, 10}, {0, 0, 0}, 60);
    return b.finish();
}

TEST(PixelFilters, AnEdgeCoversItsShareOfThePixel) {
    constexpr uint32_t kSide = 11, kMiddle = 5;
    const float pixel = 2 * 10 * std::tan(glm::radians(30.0f)) / kSide;  // m on the wall
    for (const float share : {0.25f, 0.6f, 0.8f}) {
        const SceneAsset wall = halfWall((share - 0.5f) * pixel);
        const auto middle = [&](PixelFilter filter) {
            const Reference r = trace(wall, {kSide, kSide},
                                      {.paths = {.bounces = 0, .filter = filter}, .samplesPerPixel = 4096});
            return r.bounces[0].at(kMiddle, kMiddle).x / 2;
        };
        EXPECT_FLOAT_EQ(middle(PixelFilter::kCenter), share > 0.5f ? 1 : 0) << share;
        EXPECT_NEAR(middle(PixelFilter::kBox), share, 2e-3f);
        // The window's integral up to the edge, over three pixels.
        double covered = 0, all = 0;
        for (int i = 0; i < 3000; ++i) {
            const double x = (i + 0.5) / 1000 - 1.5, t = 2 * M_PI * (x / 3 + 0.5);
            const double w =
                0.35875 - 0.48829 * std::cos(t) + 0.14128 * std::cos(2 * t) - 0.01168 * std::cos(3 * t);
            all += w;
            if (x < double(share) - 0.5) covered += w;
        }
        EXPECT_NEAR(double(middle(PixelFilter::kBlackmanHarris)), covered / all, 3e-3) << share;
    }
}

// A filter takes bounced light, emission and what lies behind edges along: the mean over many pixels stays.
TEST(PixelFilters, KeepTheMeanOfALitRoom) {
    const SceneAsset room = *scenegen::buildScene("cornell", 0);
    const auto mean = [&](PixelFilter filter) {
        const Reference r =
            trace(room, {48, 32}, {.paths = {.bounces = 2, .filter = filter}, .samplesPerPixel = 256});
        return meanOf(r.radiance);
    };
    const double centers = mean(PixelFilter::kCenter), box = mean(PixelFilter::kBox);
    EXPECT_NEAR(box / centers, 1, 0.02);
    EXPECT_NEAR(mean(PixelFilter::kBlackmanHarris) / box, 1, 0.02);
}

// A wall whose texels are black or white, and lean to one side or the other, at random.
SceneAsset speckledWall() {
    scenegen::SceneBuilder b("wall");
    b.quad("wall", {-5, -5, 0}, {10, 0, 0}, {0, 10, 0}, b.material("speckled", glm::vec3(1)));
    b.camera("camera", {2, 1.5f, 4}, {0, 0, 0}, 30);
    SceneAsset asset = b.finish();
    const uint32_t side = textureClassSize(TextureClass::k256);
    std::vector<uint8_t> colors, normals;
    for (uint32_t i = 0; i < side * side; ++i) {
        const bool white = io::hashUint(i) & 1, left = io::hashUint(i) & 2;
        for (const uint8_t value : {255, 255, 255})
            colors.push_back(white ? value : 0);
        for (const int value : {left ? 64 : 191, 128, 238})
            normals.push_back(uint8_t(value));
        for (auto* texels : {&colors, &normals})
            texels->push_back(255);
    }
    GeometryArrays& g = asset.geometry;
    g.textures[size_t(TextureClass::k256)] = {.srgb = {colors}, .linear = {normals}};
    g.materials[0].textureClass = TextureClass::k256;
    g.materials[0].baseColorLayer = g.materials[0].normalLayer = 0;
    return asset;
}

TEST(PixelFilters, TexturesAreAveragedOverThePixel) {
    const Reference r = trace(speckledWall(), {8, 5}, {.paths = {.bounces = 0}});
    double worstColor = 0, worstNormal = 0;
    for (size_t i = 0; i < r.albedo.pixels.size(); ++i) {
        ASSERT_GT(r.depth.pixels[i].x, 0);
        worstColor = std::max(worstColor, std::abs(double(r.albedo.pixels[i].x) - 0.5));
        worstNormal = std::max(worstNormal, double(glm::distance(r.normal.pixels[i], {0, 0, 1})));
    }
    std::printf("off the means of all texels: colour %.3f, normal %.3f\n", worstColor, worstNormal);
    EXPECT_LT(worstColor, 0.15);  // of single texels 0.5
    EXPECT_LT(worstNormal, 0.15);
}

// A closed room, dark but for the sun through a window of 40 cm.
SceneAsset darkRoom() {
    scenegen::SceneBuilder b("dark room");
    const uint32_t white = b.material("white", glm::vec3(0.6f));
    b.room("room", {-3, 0, -3}, {3, 3, 3}, {white, white, white, white, white, ~0u});
    const auto wall = [&](glm::vec3 corner, glm::vec3 right, glm::vec3 up) {
        b.box("wall", corner + (right + up) * 0.5f, glm::abs(right + up) + glm::vec3(0, 0, 0.1f), white);
    };
    wall({-3, 0, 3}, {6, 0, 0}, {0, 1.5f, 0});
    wall({-3, 1.9f, 3}, {6, 0, 0}, {0, 1.1f, 0});
    wall({-3, 1.5f, 3}, {2.8f, 0, 0}, {0, 0.4f, 0});
    wall({0.2f, 1.5f, 3}, {2.8f, 0, 0}, {0, 0.4f, 0});
    b.sun("sun", {0.2f, -0.8f, -1}, glm::vec3(20));
    b.camera("camera", {2.5f, 1.6f, -2.5f}, {-2, 0.5f, 1}, 70);
    return b.finish();
}

TEST(LitPoints, FindTheSameLightAsPathsAloneWithLessNoise) {
    const SceneAsset room = darkRoom();
    for (const uint32_t bounces : {1u, 4u})
        for (const bool glossy : {false, true}) {
            const auto traced = [&](bool lit, uint32_t samples) {
                return trace(room, {32, 20},
                             {.paths = {.bounces = bounces, .glossy = glossy, .litPoints = lit},
                              .samplesPerPixel = samples,
                              .layer = "indirect"});
            };
            const Reference alone = traced(false, 4096), with = traced(true, 512);
            EXPECT_NEAR(meanOf(with.indirect) / meanOf(alone.indirect), 1, 0.02) << bounces << glossy;
            EXPECT_LT(with.noise, alone.noise) << "with an eighth of the paths";
        }
}

// Every light kind has its map, and lights that cast no shadow are found by paths alone.
TEST(LitPoints, TakeEveryKindOfLight) {
    scenegen::SceneBuilder b("lights");
    const uint32_t white = b.material("white", glm::vec3(0.7f));
    b.room("room", {-2, 0, -2}, {2, 2.5f, 2}, {white, white, white, white, white, white});
    b.box("block", {0.4f, 0.5f, 0}, {0.6f, 1, 0.6f}, white);
    b.camera("camera", {1.7f, 1.8f, 1.7f}, {-1, 0.5f, -1}, 70);
    b.point("point", {0, 2, 0}, glm::vec3(1), 3);
    b.spot("spot", {-1.5f, 2, 1}, {0.5f, -1, -0.4f}, glm::vec3(8), {10, 30});
    SceneAsset asset = b.finish();
    for (const bool shadows : {true, false}) {
        for (SceneNode& node : asset.nodes)
            node.extras.castsShadow = shadows || node.name == "spot";
        const auto mean = [&](bool lit) {
            return meanOf(
                trace(
                    asset, {32, 24},
                    {.paths = {.bounces = 2, .litPoints = lit}, .samplesPerPixel = 2048, .layer = "indirect"})
                    .indirect);
        };
        EXPECT_NEAR(mean(true) / mean(false), 1, 0.01) << shadows;
    }
}

}  // namespace
}  // namespace ag::reference
