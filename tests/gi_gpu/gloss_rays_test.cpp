// Light by specular lobes at rest, seen and passed on, against path tracing of whole materials.
#include "engine/core/image_difference.h"
#include "tests/gi_gpu/bench.h"
#include "tests/gi_gpu/open_boxes.h"
#include "tools/reference/reference.h"
#include "tools/scenegen/builder.h"
#include "tools/scenegen/scenes.h"

namespace ag::gi {
using namespace render;
namespace {

Image traced(const Bench& b, uint32_t bounces, uint32_t samples) {
    const reference::RayScene rays(b.scene);
    JobRunner runner(2);
    const reference::Reference all = reference::makeReference(
        rays, b.size,
        {.paths = {.bounces = bounces, .glossy = true}, .samplesPerPixel = samples, .layer = "radiance"},
        runner, [](double) {});
    return *reference::layerOf(all, "radiance");
}

Image atRest(Bench& b) {
    return renderLayer(b.renderer, b.scene, b.size, b.settings, Layer::kRadiance,
                       framesToRest(b.settings.bounce) + 2);
}

double errorOf(const Image& image, const Image& truth) {
    return compareImages(truth, image)->relativeRmse;
}

struct Errors {
    double with, without;  // gloss rays
};

Errors errorsOf(Bench& b, const Image& truth) {
    b.settings.bounce.glossRays.enabled = true;
    const double with = errorOf(atRest(b), truth);
    b.settings.bounce.glossRays.enabled = false;
    return {with, errorOf(atRest(b), truth)};
}

// A mirror, and two walls behind the camera, one that shines and one that is lit by lamps; before them
// something small and bright.
SceneAsset behindTheCamera(float roughness, uint32_t lamps) {
    scenegen::SceneBuilder s("behind");
    const uint32_t mirror = s.material("mirror", glm::vec3(0.8f, 0.7f, 0.5f)),
                   sign = s.emissive("sign", glm::vec3(0), {2, 3, 1}),
                   bulb = s.emissive("bulb", glm::vec3(0), {30, 20, 10}),
                   gray = s.material("gray", glm::vec3(0.6f));
    s.materialAt(mirror).roughness = roughness;
    s.materialAt(mirror).metallic = 1;
    s.quad("mirror", {-1.5f, -1, -2}, {3, 0, 0}, {0, 2, 0}, mirror);
    s.quad("sign", {0, -1, 3}, {-3, 0, 0}, {0, 2, 0}, sign);
    s.quad("bulb", {0.35f, -0.6f, 2.5f}, {-0.15f, 0, 0}, {0, 0.15f, 0}, bulb);
    s.quad("wall", {3, -1, 3}, {-3, 0, 0}, {0, 2, 0}, gray);
    for (uint32_t i = 0; i < lamps; ++i)
        s.point("lamp", {1.2f + 0.1f * float(i % 4), 3, 1.6f + 0.1f * float(i / 4)},
                glm::vec3(60.0f / float(std::max(lamps, 1u))));
    s.camera("camera", {0, 0, 0.5f}, {0, 0, -2}, 50);
    return s.finish();
}

// Wide lobes see walls much as area lights have them.
TEST(GlossRays, ShowWhatIsBehindTheCamera) {
    struct Case {
        float roughness;
        double most, least;  // error, and that of area lights over it
    };
    for (const Case& c : {Case{0.1f, 0.4, 2.5}, Case{0.4f, 0.04, 0.6}})
        for (const uint32_t lamps : {1u, 12u}) {  // one with a map, and more than have maps
            Bench b(behindTheCamera(c.roughness, lamps), {64, 36});
            addBounces(b.settings);
            b.settings.bounce.texelRays.settleFrames = 48;
            b.settings.bounce.laterBounces.settleFrames = 16;
            b.settings.bounce.sky.settleFrames = 0;
            const Errors e = errorsOf(b, traced(b, 4, 256));
            std::printf("roughness %.1f, %u lamps: relative RMSE %.3f, by area lights %.3f\n",
                        double(c.roughness), lamps, e.with, e.without);
            EXPECT_LT(e.with, c.most);
            EXPECT_GT(e.without, c.least * e.with);
        }
}

// Most of what the wall gets is mirrored by a dark floor.
SceneAsset lampOverADarkFloor() {
    scenegen::SceneBuilder s("dark floor");
    const uint32_t floor = s.material("floor", glm::vec3(0.02f)),
                   white = s.material("white", glm::vec3(0.8f));
    s.materialAt(floor).roughness = 0.5f;
    s.materialAt(floor).specular = 1;
    s.quad("floor", {-2, 0, -2}, {0, 0, 4}, {4, 0, 0}, floor);
    s.quad("wall", {-2, 0, -2}, {4, 0, 0}, {0, 2.5f, 0}, white);
    s.spot("lamp", {0, 1.2f, 1.4f}, glm::normalize(glm::vec3(0, -1.2f, -1.6f)), glm::vec3(60), {12, 17});
    s.camera("camera", {0, 1.2f, 1.2f}, {0, 1.1f, -2}, 50);
    return s.finish();
}

TEST(GlossRays, FloorsMirrorLampsOntoWalls) {
    Bench b(lampOverADarkFloor(), {64, 36});
    b.settings.bounce.texelRays.settleFrames = 128;
    const Image truth = traced(b, 1, 400), rays = atRest(b);
    b.settings.bounce.texelRays.enabled = false;
    const double with = errorOf(rays, truth), without = errorOf(atRest(b), truth);
    std::printf("wall by a dark floor: mean ratio %.3f, relative RMSE %.3f; where floors are diffuse %.3f\n",
                meanOf(rays) / meanOf(truth), with, without);
    EXPECT_NEAR(meanOf(rays) / meanOf(truth), 1, 0.03);
    EXPECT_LT(with, 0.2);
    EXPECT_GT(without, 5 * with);
}

SceneAsset boxesUnderAMirror() {
    scenegen::SceneBuilder s("boxes under a mirror");
    addHallOfOpenBoxes(s);
    const uint32_t mirror = s.material("mirror", glm::vec3(0.9f));
    s.materialAt(mirror).roughness = 0.2f;
    s.materialAt(mirror).metallic = 1;
    s.quad("mirror", {-2.5f, 2.5f, -2.5f}, {5, 0, 0}, {0, 0, 5}, mirror);
    s.point("lamp", {4, 2.2f, 1}, glm::vec3(60));
    s.camera("camera", {0.3f, 0.6f, 1.5f}, {0.3f, 2.5f, 0.3f}, 50);
    return s.finish();
}

TEST(GlossRays, ShowSmallThingsWithTheLightAmongThem) {
    Bench b(boxesUnderAMirror(), {48, 27});
    addBounces(b.settings);
    b.settings.bounce.texelRays.settleFrames = b.settings.bounce.laterBounces.settleFrames = 32;
    b.settings.bounce.sky.settleFrames = 0;
    const double ratio = meanOf(atRest(b)) / meanOf(traced(b, 16, 128));
    std::printf("boxes in a mirror: mean over path tracing's %.3f\n", ratio);
    EXPECT_NEAR(ratio, 1, 0.025);  // 0.965 by draws to points alone
}

TEST(GlossRays, AStillFrameComesToRestAndSkippingChangesNoBit) {
    std::array<Image, 2> images;
    for (const bool skip : {true, false}) {
        Bench b(behindTheCamera(0.4f, 1), {64, 36});
        b.settings.bounce.texelRays.settleFrames = 16;
        b.options.skip = skip;
        for (int i = 0; i < b.restFrames(); ++i)
            b.frame();
        if (skip) {
            EXPECT_EQ(b.passesRun(), 0);
        }
        images[skip] = readImage(b.renderer, b.last.outputs.radiance);
    }
    EXPECT_TRUE(images[0].pixels == images[1].pixels);
}

// Nothing of the light before is left in what rays find.
TEST(GlossRays, ForgetLightThatChanged) {
    Bench b(behindTheCamera(0.1f, 1), {64, 36}), fresh(b.asset, {64, 36});
    const auto rest = [](Bench& of) {
        of.settings.bounce.texelRays.settleFrames = 64;
        for (int i = 0; i < of.restFrames(); ++i)
            of.frame();
        return readImage(of.renderer, of.last.outputs.radiance);
    };
    const Image before = rest(b);
    for (Bench* of : {&b, &fresh}) {
        for (RenderLight& light : of->scene.lights)
            light.intensity *= 0.25f;
        ++of->scene.lightsVersion;
    }
    const Image after = rest(b), truth = rest(fresh);
    const double off = errorOf(after, truth), change = errorOf(before, truth);
    std::printf("a lamp is dimmed: relative RMSE %.4f, of the light before %.4f\n", off, change);
    EXPECT_LT(off, 0.4 * change);
}

// What rays found stays for some frames, so that no reflection jumps.
TEST(GlossRays, FadeWhenTheCameraMoves) {
    Bench b(behindTheCamera(0.1f, 0), {64, 36}), plain(b.asset, {64, 36});
    b.settings.bounce.texelRays.settleFrames = 64;
    plain.settings.bounce.glossRays.enabled = false;
    const auto picture = [](Bench& of) {
        return renderLayer(of.renderer, of.scene, of.size, of.settings, Layer::kRadiance, 1);
    };
    for (int i = 0; i < b.restFrames(); ++i)
        b.frame();
    const Image rest = picture(b);
    const auto step = [&](Bench& of) {
        shiftCamera(of.scene, {0.002f, 0, 0});
        return picture(of);
    };
    const Image moved = step(b);
    EXPECT_EQ(b.outcome("gloss_rays.cast"), PassOutcome::kDropped);
    for (int i = 0; i < 80; ++i)
        step(b);
    EXPECT_EQ(b.outcome("gloss_rays.mix"), PassOutcome::kDropped);
    for (int i = 0; i < 81; ++i)
        step(plain);
    const double jump = errorOf(moved, rest), all = errorOf(picture(plain), rest);
    std::printf("after a step of 2 mm %.3f off the picture at rest, without rays %.3f\n", jump, all);
    EXPECT_LT(jump, 0.4 * all);
}

TEST(GlossRays, CostNothingWhereNothingIsGlossy) {
    Bench b(*scenegen::buildScene("cornell", 0), {64, 36});
    for (int i = 0; i < 4; ++i)
        b.frame();
    EXPECT_EQ(b.outcome("gloss_rays.cast"), PassOutcome::kDropped);
    EXPECT_EQ(b.outcome("gloss_rays.mix"), PassOutcome::kDropped);
}

}  // namespace
}  // namespace ag::gi
