// Light of the sky and of emissive surfaces on the device, where it is known.
#include <gtest/gtest.h>

#include <numbers>

#include "common/brdf.h"
#include "tests/gi_gpu/bench.h"
#include "tools/scenegen/builder.h"
#include "tools/scenegen/scenes.h"

namespace ag::gi {
using namespace render;
namespace {

SceneAsset floorUnder(Sky sky) {
    scenegen::SceneBuilder b("floor");
    b.quad("floor", {-40, 0, -40}, {0, 0, 80}, {80, 0, 0}, b.material("gray", glm::vec3(0.5f)));
    b.camera("camera", {0, 2, 3}, {0, 0, 0}, 20);
    b.sky(std::move(sky));
    return b.finish();
}

Image layerAfter(Bench& b, Layer layer, uint32_t frames) {
    return renderLayer(b.renderer, b.scene, b.size, render::settingsOf(layer, b.settings), layer, frames);
}

TEST(SkyLight, OpenGroundGetsAllOfIt) {
    Bench even(floorUnder(constantSky({1, 2, 4})), {96, 54});
    const Image sky = layerAfter(even, Layer::kSky, 32);
    EXPECT_NEAR(double(sky.at(48, 27).x), kPi, 0.01 * kPi);
    EXPECT_NEAR(double(sky.at(20, 40).z), 4 * kPi, 0.04 * kPi);

    const Sky clear = analyticSky(glm::normalize(glm::vec3(0.6f, -0.5f, 0.2f)), 3);
    glm::dvec3 truth(0);
    constexpr int kSteps = 512;
    for (int i = 0; i < kSteps; ++i)
        for (int j = 0; j < kSteps; ++j) {
            const double c2 = (i + 0.5) / kSteps, phi = 2 * kPi * (j + 0.5) / kSteps;
            truth +=
                glm::dvec3(skyRadiance(clear, {float(std::sqrt(1 - c2) * std::cos(phi)), float(std::sqrt(c2)),
                                               float(std::sqrt(1 - c2) * std::sin(phi))}));
        }
    truth *= kPi / (double(kSteps) * kSteps);
    Bench uneven(floorUnder(clear), {96, 54});
    EXPECT_NEAR(meanOf(layerAfter(uneven, Layer::kSky, 64)) / ((truth.x + truth.y + truth.z) / 3), 1, 0.01);
}

// The points that light bounces on from: a floor's see all of the sky, those under a roof none of it.
TEST(SkyLight, FallsOnThePointsThatReflect) {
    scenegen::SceneBuilder s("floor and roof");
    const uint32_t gray = s.material("gray", glm::vec3(0.5f));
    s.quad("floor", {-4, 0, -4}, {0, 0, 8}, {8, 0, 0}, gray);
    s.camera("camera", {0, 2, 3}, {0, 0, 0}, 20);
    s.sky(analyticSky(glm::normalize(glm::vec3(0.6f, -0.5f, 0.2f)), 3));
    Bench b(s.finish(), {32, 18});
    b.settings.bounce.laterBounces.enabled = true;
    b.output = [](GraphScope scope, const RenderFrame& f) {
        scope.output(f.bounce.emitters.texels);
        if (f.bounce.irradiance.image) scope.output(f.bounce.irradiance.image);
    };
    for (int i = 0; i < 100; ++i)
        b.frame();
    const auto light = b.read<glm::vec4>(b.last.bounce.emitters.irradiance.current);
    double sum = 0;
    for (const glm::vec4& e : light)
        sum += double(e.x + e.y + e.z) / 3;
    const double truth = meanOf(layerAfter(b, Layer::kSky, 64));
    EXPECT_NEAR(sum / double(light.size()) / truth, 1, 0.01);
}

TEST(SkyLight, WhatIsSeenOfItIsItsRadiance) {
    SceneAsset asset = floorUnder(constantSky({0.25f, 0.5f, 2}));
    Bench b(std::move(asset), {64, 36});
    CameraPose up;
    up.position = {0, 2, 0};
    up.forward = glm::normalize(glm::vec3(0.3f, 0.8f, 0.1f));
    setCamera(b.scene, up, b.size);
    ++b.scene.cameraVersion;
    EXPECT_EQ(layerAfter(b, Layer::kRadiance, 1).at(30, 20), glm::vec3(0.25f, 0.5f, 2));
}

// All that a polished floor sends on of a sky that is the same from everywhere, by quadrature of its BRDF.
TEST(SkyLight, APolishedFloorByQuadrature) {
    for (const float roughness : {0.1f, 0.4f, 1.0f})
        for (const float metallic : {0.0f, 1.0f}) {
            SceneAsset asset = floorUnder(constantSky(glm::vec3(1)));
            Material& m = asset.geometry.materials[0];
            m.roughness = roughness, m.metallic = metallic, m.specular = 1;
            Bench b(std::move(asset), {48, 28});
            const double got = double(layerAfter(b, Layer::kRadiance, 200).at(24, 14).y);
            const glm::vec3 n(0, 1, 0), v = glm::normalize(glm::vec3(0, 2, 3));
            double truth = 0;
            constexpr int kSteps = 1000;
            for (int i = 0; i < kSteps; ++i)
                for (int j = 0; j < kSteps; ++j) {
                    const float c = std::sqrt((float(i) + 0.5f) / kSteps), sine = std::sqrt(1 - c * c),
                                phi = 2 * std::numbers::pi_v<float> * (float(j) + 0.5f) / kSteps;
                    truth += double(io::metallicRoughnessBrdf(n, v,
                                                              {sine * std::cos(phi), c, sine * std::sin(phi)},
                                                              glm::vec3(0.5f), metallic, roughness, 1)
                                        .x);
                }
            truth *= kPi / (double(kSteps) * kSteps);
            EXPECT_NEAR(got / truth, 1, 0.03) << roughness << ' ' << metallic;
        }
}

TEST(SkyLight, NoneComesIntoAClosedBox) {
    SceneAsset asset = *scenegen::buildScene("furnace", 50);
    asset.sky = std::make_shared<const Sky>(constantSky(glm::vec3(1000)));
    Bench b(std::move(asset), {64, 36});
    b.settings.bounce.laterBounces.enabled = true;
    EXPECT_EQ(meanOf(layerAfter(b, Layer::kSky, 16)), 0);
}

// A wall of a box moves away: what was dark is lit within some frames, and as it would be had it never stood
// there.
TEST(SkyLight, OpensAndCloses) {
    scenegen::SceneBuilder room("room");
    const uint32_t white = room.material("white", glm::vec3(0.7f));
    room.room("walls", {-2, 0, -2}, {2, 3, 2}, {white, white, white, white, ~0u, white});
    room.box("door", {0, 1.5f, -2.1f}, {5, 4, 0.2f}, white);
    room.camera("camera", {0, 1.5f, 1.8f}, {0, 0.8f, 0}, 70);
    room.sky(constantSky(glm::vec3(5)));
    Bench b(room.finish(), {64, 36});
    b.scene.instances.back().movable = true;
    for (Material& m : b.asset.geometry.materials)
        m.doubleSided = true;  // walls seen from outside are walls, too
    b.renderer.load(b.asset.geometry);
    EXPECT_LT(meanOf(layerAfter(b, Layer::kSky, 8)), 1e-6);
    const auto moveDoor = [&](float by) {
        b.scene.instances.back().worldFromLocal[3].y += by;
        const uint32_t row = uint32_t(b.scene.instances.size()) - 1;
        b.scene.changedInstances = {{row, row + 1}};
        b.scene.allInstancesChanged = false;
        ++b.scene.instancesVersion;
    };
    moveDoor(20);
    const double open = meanOf(layerAfter(b, Layer::kSky, 100));
    EXPECT_GT(open, 0.5);
    moveDoor(-20);
    layerAfter(b, Layer::kSky, 1);
    EXPECT_LT(meanOf(layerAfter(b, Layer::kSky, 300)), 0.02 * open) << "the mean forgets what was";
}

TEST(SkyLight, AStillFrameComesToRestAndSkippingChangesNoBit) {
    RenderSettings settings;
    settings.bounce.sky.settleFrames = 6;
    settings.bounce.laterBounces = {.enabled = true, .settleFrames = 6};
    expectRestAndNoBitSkipped(*scenegen::buildScene("courtyard", 0), {64, 36}, settings, 40);
}

TEST(SkyLight, ASceneWithoutItDeclaresNothingOfIt) {
    Bench b(*scenegen::buildScene("cornell", 0), {64, 36});
    b.frame();
    for (const PassReport& pass : b.renderer.graph().report()) {
        EXPECT_FALSE(pass.name.starts_with("sky.")) << pass.name;
        EXPECT_FALSE(pass.name.starts_with("surface_emitters.")) << pass.name;
    }
}

// A square that shines over a floor, on a pole that does not matter.
SceneAsset shiningSquare(glm::vec3 radiance, bool doubleSided) {
    scenegen::SceneBuilder b("square");
    b.quad("floor", {-2, 0, -2}, {0, 0, 4}, {4, 0, 0}, b.material("gray", glm::vec3(0.5f)));
    const uint32_t glow = b.emissive("glow", glm::vec3(0), radiance);
    b.materialAt(glow).doubleSided = doubleSided;
    b.quad("square", {-0.25f, 1, -0.25f}, {0.5f, 0, 0}, {0, 0, 0.5f}, glow);
    b.camera("camera", {0, 2.2f, 2.2f}, {0, 0, 0}, 60);
    return b.finish();
}

TEST(EmissiveLight, PointsHoldTheSurfacesFlux) {
    for (const bool doubleSided : {false, true}) {
        Bench b(shiningSquare({6, 3, 0}, doubleSided), {64, 36});
        b.output = [](GraphScope scope, const RenderFrame& f) { scope.output(f.bounce.emitters.texels); };
        b.frame();
        glm::dvec3 flux(0);
        double down = 0;
        for (const io::RsmTexel& t : b.read<io::RsmTexel>(b.last.bounce.emitters.texels)) {
            flux += glm::dvec3(t.flux);
            if (t.normal.y < 0) down += double(t.flux.x);
        }
        EXPECT_NEAR(flux.x / (6 * kPi * 0.25 * (doubleSided ? 2 : 1)), 1, 0.005);
        EXPECT_NEAR(flux.y / flux.x, 0.5, 1e-6);
        EXPECT_NEAR(down / flux.x, doubleSided ? 0.5 : 1, 0.01);
    }
}

TEST(EmissiveLight, AFloorBelowByQuadrature) {
    Bench b(shiningSquare({6, 3, 0}, false), {64, 36});
    const Image light = layerAfter(b, Layer::kEmissive, 40);
    double got = 0, truth = 0;
    for (int y = 0; y < 36; ++y)
        for (int x = 0; x < 64; ++x) {
            const RenderCamera& c = b.scene.camera;
            const glm::vec4 h =
                c.worldFromClip *
                glm::vec4((glm::vec2(x, y) + 0.5f) / glm::vec2(b.size) * 2.0f - 1.0f, 0.5f, 1);
            const glm::vec3 d = glm::vec3(h) / h.w - c.position;
            const glm::vec3 place = c.position - d * (c.position.y / d.y);
            const glm::vec3 atSquare = c.position - d * ((c.position.y - 1) / d.y);
            const bool square = std::abs(atSquare.x) < 0.27f && std::abs(atSquare.z) < 0.27f;
            if (std::abs(place.x) > 1.9f || std::abs(place.z) > 1.9f || square) continue;
            double e = 0;
            constexpr int kSteps = 16;
            for (int i = 0; i < kSteps; ++i)
                for (int j = 0; j < kSteps; ++j) {
                    const glm::dvec3 to((i + 0.5) / kSteps * 0.5 - 0.25 - double(place.x), 1,
                                        (j + 0.5) / kSteps * 0.5 - 0.25 - double(place.z));
                    e += 6 * 0.25 / (kSteps * kSteps) / (glm::dot(to, to) * glm::dot(to, to));
                }
            got += double(light.at(x, y).x), truth += e;
            EXPECT_NEAR(double(light.at(x, y).x), e, 0.05 * e + 0.01) << x << ' ' << y;
        }
    EXPECT_NEAR(got / truth, 1, 0.01);
}

TEST(EmissiveLight, GoesOnAfterItsFirstSurface) {
    Bench b(*scenegen::buildScene("neon", 0), {64, 36});
    b.settings.bounce.laterBounces.enabled = true;
    const double all = meanOf(layerAfter(b, Layer::kIndirect, 60));
    EXPECT_GT(all, 0.05 * meanOf(layerAfter(b, Layer::kEmissive, 1)));
}

}  // namespace
}  // namespace ag::gi
