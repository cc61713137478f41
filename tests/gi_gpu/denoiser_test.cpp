// Few samples a pixel and the denoiser: the mean stays true, surfaces keep their light, light that changes
// arrives.
#include <gtest/gtest.h>

#include <cmath>

#include "gi/upsampling.h"
#include "tests/gi_gpu/bench.h"
#include "tests/gi_gpu/bumpy.h"
#include "tools/scenegen/builder.h"
#include "tools/scenegen/scenes.h"

namespace ag::gi {
using namespace render;
using test::withWaves;
namespace {

std::unique_ptr<Bench> stochasticBench(SceneAsset asset, glm::uvec2 size, const char* preset = "stochastic") {
    auto b = std::make_unique<Bench>(std::move(asset), size);
    EXPECT_TRUE(applyPreset(preset, b->settings));
    b->settings.bounce.rsm.resolution = 64;
    b->settings.bounce.stochasticRsm.settleFrames = 1'000'000;
    b->output = [](GraphScope scope, const RenderFrame& f) {
        if (f.bounce.bounce1.image) scope.output(f.bounce.bounce1.image);
    };
    return b;
}

Image bounceImage(Bench& b) {
    b.frame();
    return b.last.bounce.bounce1.image ? readImage(b.renderer, b.last.bounce.bounce1.image)
                                       : Image(int(b.size.x), int(b.size.y));
}

double meanOverFrames(Bench& b, int frames) {
    double sum = 0;
    for (int i = 0; i < frames; ++i)
        sum += meanOf(bounceImage(b)) / frames;
    return sum;
}

// What a surface's own constant light is, the denoiser gives back: nothing crosses edges, and pixels left out
// get what is theirs. The normals stand for it. Sides that no spacing divides.
TEST(Denoiser, KeepsWhatIsConstantOnASurfaceHoweverTheCameraMoves) {
    Bench b(*scenegen::buildScene("cornell", 0), {163, 97});
    b.settings.technique = Technique::kNone;
    b.settings.bounce.spacing = 1;  // it is downsampled below
    DenoiserSettings s{.enabled = true};
    CameraPose pose = cameraOf(b.asset, 0);
    for (const uint32_t spacing : {1u, 2u, 3u})
        for (const bool separable : {true, false}) {
            DenoiserHistory history;
            s.separable = separable;
            Image normals, result;
            for (uint32_t frame = 0; frame < 12; ++frame) {
                pose.position.x += spacing == 2 ? -0.02 : 0.02;
                setCamera(b.scene, pose, b.size);
                ImageHandle normal, out;
                b.renderer.render(
                    b.scene, b.size, b.settings, b.options,
                    [&](GraphScope scope, const SceneView& view, const RenderFrame& f) {
                        normal = f.gbuffer.surfaces.normal;
                        const Surfaces downsampled = addDownsampled(scope, f.gbuffer.surfaces, spacing);
                        const Irradiance steady = addDenoiser(scope, downsampled, view.scene->originVersion,
                                                              {{downsampled.normal}, 1, frame}, s, history);
                        out = addUpsampling(scope, f.gbuffer.surfaces, downsampled, steady).image;
                        scope.output(normal);
                        scope.output(out);
                    });
                normals = readImage(b.renderer, normal);
                result = readImage(b.renderer, out);
            }
            size_t off = 0;
            for (size_t i = 0; i < result.pixels.size(); ++i) {
                const glm::vec3 in = glm::max(normals.pixels[i], glm::vec3(0));
                off += glm::length(result.pixels[i] - in) > 0.02f;
            }
            std::printf("every %u. pixel, separable %d: %zu of %zu pixels are off\n", spacing, separable, off,
                        result.pixels.size());
            EXPECT_LT(off, result.pixels.size() * spacing / 1000);
        }
}

// Light that varies over surfaces comes out as where every pixel was gathered, but in creases, where it
// varies within few pixels.
TEST(Upsampling, IsWhatAllPixelsWouldHave) {
    Bench b(*scenegen::buildScene("occluder", 0), {320, 180});
    b.settings.bounce.spacing = 1;
    for (const uint32_t spacing : {2u, 3u}) {
        ImageHandle all, spread;
        for (int frame = 0; frame < 8; ++frame)  // clusters settle
            b.renderer.render(
                b.scene, b.size, b.settings, b.options,
                [&](GraphScope scope, const SceneView&, const RenderFrame& f) {
                    all = f.bounce.bounce1.image;
                    const Surfaces downsampled = addDownsampled(scope, f.gbuffer.surfaces, spacing);
                    const Irradiance taken{addDownsampledImage(scope, "test.downsampled", all, spacing)};
                    spread = addUpsampling(scope, f.gbuffer.surfaces, downsampled, taken).image;
                    scope.output(all);
                    scope.output(spread);
                });
        expectAlike(readImage(b.renderer, spread), readImage(b.renderer, all), spacing);
    }
}

// A surface that is turned from pixel to pixel takes light by its own normal, not by the gathered
// neighbours'.
TEST(Upsampling, TakesLightAsEachPixelIsTurned) {
    Bench b(withWaves(*scenegen::buildScene("cornell", 0)), {320, 180});
    const auto bounce = [&](uint32_t spacing) {
        b.settings.bounce.spacing = spacing;
        b.output = [](GraphScope scope, const RenderFrame& f) { scope.output(f.bounce.bounce1.image); };
        for (int frame = 0; frame < 8; ++frame)
            b.frame();
        EXPECT_TRUE(b.last.gbuffer.surfaces.normalMapped);
        return readImage(b.renderer, b.last.bounce.bounce1.image);
    };
    const Image truth = bounce(1), image = bounce(2);
    double off = 0;
    for (size_t i = 0; i < truth.pixels.size(); ++i)
        off += double(std::abs(luminanceOf(image.pixels[i] - truth.pixels[i])));
    off /= double(truth.pixels.size()) * meanOf(truth);
    std::printf("waves: off by %.4f of the mean, mean ratio %.4f\n", off, meanOf(image) / meanOf(truth));
    EXPECT_LT(off, 0.025);  // 0.03 with the light as the gathered pixels took it
    EXPECT_NEAR(meanOf(image) / meanOf(truth), 1, 0.01);
}

// The mean over many frames does not depend on radius or samples but for the light beyond the disk, and with
// the disk over all of the map it is that of every texel.
TEST(StochasticRsm, MeanIsThatOfAllTexelsInTheDisk) {
    const auto b = stochasticBench(*scenegen::buildScene("cornell", 0), {48, 32});
    b->settings.bounce.denoiser.enabled = false;
    b->settings.bounce.stochasticRsm.visible = false;
    for (const float radius : {0.05f, 0.2f}) {
        b->settings.bounce.stochasticRsm = {.samples = 4096, .radius = radius};  // fixed, dense: the integral
        const double integral = meanOf(bounceImage(*b));
        for (const uint32_t samples : {1u, 8u}) {
            b->settings.bounce.stochasticRsm = {
                .samples = samples, .radius = radius, .random = true, .settleFrames = 1'000'000};
            const double mean = meanOverFrames(*b, 512);
            std::printf("radius %.2f, %u samples: mean over 512 frames / integral over the disk %.4f\n",
                        double(radius), samples, mean / integral);
            EXPECT_NEAR(mean / integral, 1, 0.008);
        }
    }
    b->settings.bounce.stochasticRsm = {
        .samples = 8, .random = true, .whole = true, .settleFrames = 1'000'000};
    const double whole = meanOverFrames(*b, 512);
    b->settings.technique = Technique::kRsmBrute;
    const double brute = meanOf(bounceImage(*b));
    std::printf("half of 8 samples from all of the map: mean over 512 frames / every texel %.4f\n",
                whole / brute);
    EXPECT_NEAR(whole / brute, 1, 0.008);
}

// What stands between, by the clusters' shadow maps: about as much light as the area lights' shadows leave.
TEST(StochasticRsm, SamplesBehindAnObstacleDoNotArrive) {
    const auto settled = [](const char* preset, bool visible) {
        const auto b = stochasticBench(*scenegen::buildScene("occluder", 0), {96, 64}, preset);
        b->settings.bounce.rsm.resolution = 128;
        b->settings.bounce.stochasticRsm.visible = visible;
        for (int i = 0; i < 40; ++i)
            b->frame();
        return meanOf(bounceImage(*b));
    };
    const double visible = settled("stochastic", true), open = settled("stochastic", false),
                 areaLights = settled("afterglow", true);
    std::printf("occluder, mean irradiance: samples seen %.4f, all %.4f, area lights %.4f\n", visible, open,
                areaLights);
    EXPECT_NEAR(visible / areaLights, 1, 0.05);
    EXPECT_GT(open / areaLights, 1.2);
}

TEST(Denoiser, LightThatChangesArrivesAndGoes) {
    scenegen::SceneBuilder s("two lights");
    const uint32_t white = s.material("white", glm::vec3(0.7f));
    s.room("room", {-2, 0, -2}, {2, 3, 2}, {white, white, white, white, white, white});
    s.spot("steady", {0, 2.5f, 0}, {0.3f, -1, 0.1f}, glm::vec3(10), {30, 40});
    s.spot("switched", {1, 1.5f, 1}, {-1, -0.1f, -0.2f}, glm::vec3(30), {30, 40});
    s.camera("camera", {1.8f, 1.5f, 1.8f}, {-1, 1, -1}, 70);
    const auto b = stochasticBench(s.finish(), {96, 64});
    b->settings.bounce.stochasticRsm.radius = 1;
    const auto strengthen = [&](float factor) {
        b->scene.lights[1].intensity = glm::vec3(30 * factor);
        ++b->scene.lightsVersion;
    };
    const double both = (meanOverFrames(*b, 64), meanOverFrames(*b, 32));
    strengthen(0.01f);
    const double after64 = (meanOverFrames(*b, 64), meanOf(bounceImage(*b)));
    const double one = meanOverFrames(*b, 64);
    strengthen(1);
    for (int i = 0; i < 7; ++i)
        b->frame();
    const double after8 = meanOf(bounceImage(*b));
    std::printf(
        "two lights %.3f; 64 frames after one goes %.3f of %.3f; 8 frames after it comes %.3f of "
        "the rise\n",
        both, after64, one, (after8 - one) / (both - one));
    EXPECT_LT(one, 0.7 * both);
    EXPECT_NEAR(after64, one, 0.01 * both);
    EXPECT_GT((after8 - one) / (both - one), 0.9);
    b->scene.lights.clear();
    ++b->scene.lightsVersion;
    EXPECT_EQ(meanOf(bounceImage(*b)), 0);
}

// Less noise by far, the same light on average; and no trace of what was before a cut, a change of size or of
// histories.
TEST(Denoiser, SmoothsAndForgetsWhatIsGone) {
    const auto b = stochasticBench(*scenegen::buildScene("cornell", 0), {160, 96});
    b->settings.bounce.denoiser.enabled = false;
    b->settings.bounce.stochasticRsm.visible = false;  // its maps would settle meanwhile
    b->settings.bounce.stochasticRsm.samples = 4096;
    const Image truth = bounceImage(*b);
    b->settings.bounce.stochasticRsm.samples = 8;
    const auto errorOf = [&](const Image& image) {
        double off = 0;
        for (size_t i = 0; i < image.pixels.size(); ++i) {
            EXPECT_TRUE(std::isfinite(image.pixels[i].x + image.pixels[i].y + image.pixels[i].z));
            off += double(glm::length(image.pixels[i] - truth.pixels[i]));
        }
        return off / double(image.pixels.size()) / std::sqrt(3.0) / meanOf(truth);
    };
    const double raw = errorOf(bounceImage(*b));
    b->settings.bounce.denoiser.enabled = true;
    for (int i = 0; i < 32; ++i)
        b->frame();
    const double smooth = errorOf(bounceImage(*b));
    std::printf("relative mean difference: 8 samples %.3f, denoised %.3f\n", raw, smooth);
    EXPECT_LT(smooth, 0.4 * raw);
    const CameraPose pose = cameraOf(b->asset, 0);
    CameraPose elsewhere = pose;
    elsewhere.position += glm::dvec3(0.5, 0.3, -1.0);
    elsewhere.forward = glm::normalize(glm::vec3(-0.8f, 0.1f, -0.6f));
    setCamera(b->scene, elsewhere, b->size);
    b->frame();
    setCamera(b->scene, pose, b->size);
    const double cut = errorOf(bounceImage(*b));
    EXPECT_LT(cut, 0.8 * raw) << "the first frame after a cut is filtered over the screen alone";
    b->settings.bounce.denoiser.mostLength = 1;
    const double early = (b->frame(), errorOf(bounceImage(*b)));
    for (int i = 0; i < 16; ++i)
        b->frame();
    EXPECT_NEAR(errorOf(bounceImage(*b)) / early, 1, 0.15) << "without a history no frame knows of others";
    EXPECT_GT(early, 1.2 * smooth);
    b->size = {80, 48};
    setCamera(b->scene, pose, b->size);
    for (const glm::vec3& p : bounceImage(*b).pixels)
        ASSERT_TRUE(std::isfinite(p.x + p.y + p.z));
}

// A box that moves through a lit room: a green one, so that its pixels are known.
struct MovingBox {
    std::unique_ptr<Bench> b;
    uint32_t row = 0;
    ImageHandle albedo;

    explicit MovingBox(const DenoiserSettings& denoiser) {
        scenegen::SceneBuilder s("moving box");
        const uint32_t white = s.material("white", glm::vec3(0.7f)),
                       red = s.material("red", {0.7f, 0.2f, 0.1f}),
                       green = s.material("green", {0.1f, 0.7f, 0.1f});
        s.room("room", {-2, 0, -2}, {2, 3, 2}, {red, white, white, white, white, white});
        s.spot("lamp", {-0.5f, 2.5f, 0}, {-1, -0.6f, 0.1f}, glm::vec3(20), {30, 40});
        s.camera("camera", {1.8f, 1.6f, 1.8f}, {-0.6f, 0.8f, -0.6f}, 70);
        s.box("box", {0, 0.4f, 0}, glm::vec3(0.8f), green);
        b = stochasticBench(s.finish(), {320, 192});
        b->settings.bounce.stochasticRsm.radius = 1;
        b->settings.bounce.denoiser = denoiser;
        b->output = [this](GraphScope scope, const RenderFrame& f) {
            albedo = f.gbuffer.surfaces.albedo;
            scope.output(f.gbuffer.surfaces.albedo);
            scope.output(f.bounce.bounce1.image);
            if (f.gbuffer.surfaces.motion) scope.output(f.gbuffer.surfaces.motion);
        };
        row = uint32_t(b->scene.instances.size()) - 1;
        b->scene.instances[row].movable = true;
        for (int i = 0; i < 36; ++i)
            b->frame();
    }
    void place(glm::vec3 center, float yaw) {
        const glm::mat3 turn = glm::mat3_cast(glm::angleAxis(yaw, glm::vec3(0, 1, 0)));
        b->scene.instances[row].worldFromLocal = glm::mat4x3(turn[0], turn[1], turn[2], center);
        b->scene.changedInstances = {{row, row + 1}};
        b->scene.allInstancesChanged = false;
        ++b->scene.instancesVersion;
    }
    // After 24 frames on the way, and what is seen standing there.
    struct Pair {
        Image moving, standing, albedo;
    };
    Pair walk(glm::vec3 step, float turn) {
        Pair pair;
        for (int i = 0; i <= 24; ++i) {
            place(glm::vec3(0, 0.4f, 0) + step * float(i - 12), turn * float(i));
            pair.moving = bounceImage(*b);
        }
        for (int i = 0; i < 64; ++i)
            b->frame();
        pair.standing = bounceImage(*b);
        pair.albedo = readImage(b->renderer, albedo);
        return pair;
    }
};

// Relative mean difference over the box's pixels or all others.
double differenceOn(const MovingBox::Pair& pair, bool box) {
    double off = 0, mean = 0;
    for (size_t i = 0; i < pair.moving.pixels.size(); ++i) {
        const glm::vec3 albedo = pair.albedo.pixels[i];
        if ((albedo.y > 2 * albedo.x) != box) continue;
        off += double(luminanceOf(glm::abs(pair.moving.pixels[i] - pair.standing.pixels[i])));
        mean += double(luminanceOf(pair.standing.pixels[i]));
    }
    return off / mean;
}

TEST(Denoiser, NoTrailsBehindWhatMoves) {
    const auto walk = [](bool adaptive) {
        return MovingBox({.enabled = true, .adaptive = adaptive}).walk({0.04f, 0, 0.04f}, 0.03f);
    };
    const MovingBox::Pair ours = walk(true), plain = walk(false);
    std::printf(
        "a box at 3.4 m/s that turns, relative difference to the same box at rest: on it %.3f, besides %.3f; "
        "histories that do not adapt %.3f, %.3f\n",
        differenceOn(ours, true), differenceOn(ours, false), differenceOn(plain, true),
        differenceOn(plain, false));
    EXPECT_LT(differenceOn(ours, true), 0.15);
    EXPECT_LT(differenceOn(ours, false), 0.05);
    EXPECT_LT(differenceOn(ours, true), 0.5 * differenceOn(plain, true));
    EXPECT_LT(differenceOn(ours, false), 0.8 * differenceOn(plain, false));
}

// Towards the camera nothing is where it was: without its motion each frame starts anew.
TEST(Denoiser, HistoriesFollowWhatMoves) {
    const auto walk = [](bool motion) {
        return MovingBox({.enabled = true, .rounds = 0, .motion = motion}).walk({0.01f, 0, 0.02f}, 0);
    };
    const double with = differenceOn(walk(true), true), without = differenceOn(walk(false), true);
    std::printf("relative difference on a box that comes nearer: with its motion %.3f, without %.3f\n", with,
                without);
    EXPECT_LT(with, 0.85 * without);
}

TEST(GBuffer, MotionIsTheWayBackOfWhatMoved) {
    MovingBox m({.enabled = true});
    m.place({0, 0.4f, 0}, 0);
    m.b->frame();
    const glm::vec3 step(0.05f, 0.01f, -0.03f);
    m.place(glm::vec3(0, 0.4f, 0) + step, 0);
    m.b->frame();
    ASSERT_TRUE(m.b->last.gbuffer.surfaces.motion);
    const Image motion = readImage(m.b->renderer, m.b->last.gbuffer.surfaces.motion),
                albedo = readImage(m.b->renderer, m.albedo);
    size_t box = 0;
    for (size_t i = 0; i < motion.pixels.size(); ++i) {
        const bool onBox = albedo.pixels[i].y > 2 * albedo.pixels[i].x;
        box += onBox;
        ASSERT_LT(glm::length(motion.pixels[i] + (onBox ? step : glm::vec3(0))), 1e-4f) << "pixel " << i;
    }
    EXPECT_GT(box, 500u);
    m.b->scene.changedInstances.clear();
    m.b->frame();
    EXPECT_FALSE(m.b->last.gbuffer.surfaces.motion) << "nothing moved";
}

TEST(Denoiser, RestsWhenNothingChanges) {
    const auto b = stochasticBench(*scenegen::buildScene("cornell", 0), {64, 48});
    b->settings.bounce.stochasticRsm.settleFrames = 4;
    for (int i = 0; i < 40; ++i)  // clusters rest after 32
        b->frame();
    EXPECT_EQ(b->passesRun(), 0);
}

}  // namespace
}  // namespace ag::gi
