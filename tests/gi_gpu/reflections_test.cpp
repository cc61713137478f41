// Reflections of the picture in itself, on mirrors whose image is known.
#include <gtest/gtest.h>

#include <optional>

#include "common/brdf.h"
#include "tests/gi_gpu/bench.h"
#include "tools/scenegen/builder.h"

namespace ag::gi {
using namespace render;
namespace {

const glm::vec3 kTint(0.9f, 0.7f, 0.4f), kShine(2, 3, 1);
constexpr float kWallAt = -2, kWallSide = 0.8f, kWallFoot = 0.2f, kWallTop = 1.3f;

SceneAsset wallAboveFloor(float roughness) {
    scenegen::SceneBuilder b("mirror");
    const uint32_t floor = b.material("mirror", kTint), wall = b.emissive("wall", glm::vec3(0), kShine);
    b.materialAt(floor).roughness = roughness;
    b.materialAt(floor).metallic = 1;
    b.quad("floor", {-3, 0, -4}, {0, 0, 8}, {6, 0, 0}, floor);
    b.quad("wall", {-kWallSide, kWallFoot, kWallAt}, {2 * kWallSide, 0, 0}, {0, kWallTop - kWallFoot, 0},
           wall);
    b.camera("camera", {0, 1.1f, 2}, {0, 0.3f, -1.2f}, 60);
    return b.finish();
}

// Unit, through a pixel's centre.
glm::vec3 directionThrough(const RenderCamera& c, glm::vec2 pixel, glm::vec2 size) {
    const glm::vec4 h = c.worldFromClip * glm::vec4((pixel + 0.5f) / size * 2.0f - 1.0f, 0.5f, 1);
    return glm::normalize(glm::vec3(h) / h.w - c.position);
}

// What the floor shows at a place in the picture, or nothing where it is not the mirror.
std::optional<glm::vec3> mirrored(const RenderCamera& c, glm::vec2 pixel, glm::vec2 size) {
    const glm::vec3 d = directionThrough(c, pixel, size);
    if (d.y > -0.02f) return {};
    const glm::vec3 place = c.position - d * (c.position.y / d.y), r(d.x, -d.y, d.z);
    if (place.z < kWallAt) return {};  // the floor behind the wall, or the wall
    const glm::vec3 met = place + r * ((kWallAt - place.z) / r.z);
    const bool hits = std::abs(met.x) < kWallSide && met.y > kWallFoot && met.y < kWallTop;
    return hits ? kShine * io::fresnelSchlick(kTint, glm::vec3(1), r.y) : glm::vec3(0);
}

// Not where its outline is within a pixel.
bool isPlain(const RenderCamera& c, glm::vec2 pixel, glm::vec2 size) {
    const bool lit = mirrored(c, pixel, size).value_or(glm::vec3(0)).x > 0;
    for (const glm::vec2 aside : {glm::vec2(1, 0), glm::vec2(-1, 0), glm::vec2(0, 1), glm::vec2(0, -1)}) {
        const auto other = mirrored(c, pixel + aside, size);
        if (!other || (other->x > 0) != lit) return false;
    }
    return true;
}

TEST(Reflections, AFlatMirrorShowsTheWallWhereItIs) {
    Bench b(wallAboveFloor(0), {160, 96});
    b.settings.technique = Technique::kNone;
    const Image got = renderLayer(b.renderer, b.scene, b.size, b.settings, Layer::kRadiance, 2);
    int shown = 0, wrong = 0;
    for (int y = 0; y < got.height; ++y)
        for (int x = 0; x < got.width; ++x) {
            const auto truth = mirrored(b.scene.camera, {x, y}, b.size);
            if (!truth || !isPlain(b.scene.camera, {x, y}, b.size)) continue;
            shown += truth->x > 0;
            wrong += glm::length(got.at(x, y) - *truth) > 0.01f * glm::length(kShine);
        }
    std::printf("%d pixels show the wall, %d are wrong\n", shown, wrong);
    EXPECT_GT(shown, 400);
    EXPECT_LT(wrong, 5);
}

// Surfaces that rays cannot find on the screen stay as area lights have them.
TEST(Reflections, WhatIsOffTheScreenIsLeftToAreaLights) {
    scenegen::SceneBuilder s("before the camera");
    const uint32_t mirror = s.material("mirror", kTint), gray = s.material("gray", glm::vec3(0.6f));
    s.materialAt(mirror).roughness = 0.1f;
    s.materialAt(mirror).metallic = 1;
    s.quad("mirror", {-1, -1, -2}, {2, 0, 0}, {0, 2, 0}, mirror);
    s.quad("behind", {3, -3, 4}, {-6, 0, 0}, {0, 6, 0}, gray);
    s.spot("lamp", {0, 0, -1}, {0, 0, 1}, glm::vec3(40), {.inner = 30, .outer = 40});
    s.camera("camera", {0, 0, 0}, {0, 0, -2}, 40);
    const SceneAsset asset = s.finish();
    std::array<Image, 2> images;
    for (const bool on : {false, true}) {
        Bench b(asset, {64, 48});
        b.settings.reflections.enabled = on;
        images[on] = renderLayer(b.renderer, b.scene, b.size, b.settings, Layer::kRadiance, 4);
        EXPECT_EQ(on, bool(b.renderer.graph().findImage("reflections.radiance")));
    }
    EXPECT_GT(meanOf(images[0]), 0.01);
    EXPECT_EQ(images[0].pixels, images[1].pixels);
}

TEST(Reflections, NoPassWhereNothingIsSmooth) {
    Bench b(wallAboveFloor(0.15f), {64, 36});
    b.frame();
    EXPECT_FALSE(b.renderer.graph().findImage("reflections.radiance"));
    EXPECT_FALSE(b.renderer.graph().findImage("reflections.found"));
}

TEST(Reflections, RestAtOnceAndNoBitIsSkipped) {
    RenderSettings settings;
    settings.technique = Technique::kNone;
    expectRestAndNoBitSkipped(wallAboveFloor(0.1f), {96, 54}, settings, 3);
}

}  // namespace
}  // namespace ag::gi
