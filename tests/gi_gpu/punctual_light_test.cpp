// Many punctual lights: what is drawn again, soft shadows against a disk of light, tiles, and punctual lights
// that come and go.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "common/lights.h"
#include "common/sampling.h"
#include "shaders/gbuffer/view_points_io.h"
#include "tests/gi_gpu/bench.h"
#include "tools/scenegen/builder.h"
#include "tools/scenegen/scenes.h"

namespace ag::gi {
using namespace render;
namespace {

std::unique_ptr<Bench> directBench(SceneAsset asset, glm::uvec2 size = {160, 96}) {
    auto b = std::make_unique<Bench>(std::move(asset), size);
    b->settings.technique = Technique::kNone;
    b->output = [](GraphScope scope, const RenderFrame& f) { scope.output(f.direct.image); };
    return b;
}

const PassReport* passNamed(Bench& b, std::string_view name) {
    for (const PassReport& pass : b.renderer.graph().report())
        if (pass.name == name) return &pass;
    return nullptr;
}

Image directImage(Bench& b) {
    b.frame();
    return readImage(b.renderer, b.last.direct.image);
}

void moveInstance(Bench& b, uint32_t row, glm::vec3 by) {
    b.scene.instances[row].worldFromLocal[3] += by;
    b.scene.allInstancesChanged = false;
    b.scene.changedInstances = {{row, row + 1}};
    ++b.scene.instancesVersion;
}

TEST(PunctualShadows, OnlyFacesThatSeeAMovingBoxAreDrawnAgain) {
    const auto kept = directBench(*scenegen::buildScene("lamps", 14)),
               anew = directBench(*scenegen::buildScene("lamps", 14));
    anew->options.skip = false;
    for (Bench* b : {kept.get(), anew.get()})
        b->settings.lightClusters = {.growth = 0};  // a map each
    kept->frame();
    const PassReport* faces = passNamed(*kept, "punctual_shadows.faces");
    ASSERT_NE(faces, nullptr);
    EXPECT_GT(faces->patches, 30u);
    EXPECT_EQ(faces->patchesDrawn, faces->patches) << "all are drawn at first";
    kept->frame();
    EXPECT_EQ(passNamed(*kept, "punctual_shadows.faces")->outcome, PassOutcome::kSkipped) << "nothing moves";
    const uint32_t crate = uint32_t(kept->scene.instances.size()) - 1;
    anew->frame();
    anew->frame();
    for (int step = 0; step < 3; ++step) {
        moveInstance(*kept, crate, {0, 0, 0.2f});
        moveInstance(*anew, crate, {0, 0, 0.2f});
        const Image a = directImage(*kept), b = directImage(*anew);
        EXPECT_EQ(a.pixels, b.pixels) << "faces that were kept show what drawing them anew does";
        faces = passNamed(*kept, "punctual_shadows.faces");
        std::printf("a crate moves: %u of %u faces drawn again\n", faces->patchesDrawn, faces->patches);
        EXPECT_GT(faces->patchesDrawn, 0u);
        EXPECT_LT(faces->patchesDrawn, faces->patches / 2);
        EXPECT_EQ(passNamed(*anew, "punctual_shadows.faces")->patchesDrawn, faces->patches);
    }
}

// A light in a closed box, nearly touching a wall of it, over a floor that is seen by all seams of its cube.
TEST(PunctualShadows, NothingLeavesAClosedBox) {
    for (const float size : {0.3f, 1.0f, 40.0f}) {
        scenegen::SceneBuilder b("box");
        const uint32_t gray = b.material("gray", glm::vec3(0.5f));
        b.quad("floor", size * glm::vec3(-3, 0, -3), {0, 0, 6 * size}, {6 * size, 0, 0}, gray);
        b.box("box", size * glm::vec3(0, 1.5f, 0), glm::vec3(0.6f * size), gray);
        b.point("lamp", size * glm::vec3(0.297f, 1.5f, 0.02f), glm::vec3(100 * size * size));
        b.camera("camera", size * glm::vec3(0, 4, 4), glm::vec3(0), 60);
        const auto bench = directBench(b.finish(), {320, 192});
        float most = 0;
        for (const glm::vec3& pixel : directImage(*bench).pixels)
            most = std::max(most, pixel.x);
        EXPECT_EQ(most, 0) << size;
    }
}

TEST(PunctualLighting, TilesLeaveOutOnlyWhatDoesNotReachThem) {
    const auto b = directBench(*scenegen::buildScene("lamps", 256));
    b->settings.lightClusters.most = 16;
    const Image tiles = directImage(*b);
    b->settings.punctualLighting.tiles = false;
    const Image all = directImage(*b);
    double most = 0, mean = 0;
    for (size_t i = 0; i < all.pixels.size(); ++i) {
        most = std::max(most, double(glm::length(all.pixels[i] - tiles.pixels[i])));
        mean += double(glm::length(all.pixels[i])) / double(all.pixels.size());
    }
    EXPECT_GT(mean, 0.1);
    EXPECT_LT(most, 0.01 * mean) << "half floats, summed in the same order";
}

// What is measured is the light of each light, shadows aside, at the points that stand for the view.
TEST(PunctualRelevance, IsTheLightAtTheViewsPoints) {
    const auto b = directBench(*scenegen::buildScene("lamps", 80));
    b->output = [](GraphScope scope, const RenderFrame& f) {
        scope.output(f.direct.image);
        scope.output(f.bounce.viewPoints);
    };
    b->frame();
    PunctualRelevance relevance;
    relevance.set(b->read<std::byte>(b->renderer.graph().findBuffer("punctual_relevance.relevance")));
    const auto points = b->read<io::ViewPoint>(b->last.bounce.viewPoints);
    uint32_t measured = 0;
    for (const RenderLight& light : b->scene.lights) {
        double sum = 0;
        for (const io::ViewPoint& p : points) {
            const glm::vec3 d = light.position - p.position;
            const float distance = glm::length(d), cosine = std::max(glm::dot(p.normal, d / distance), 0.0f);
            const float e = cosine / (distance * distance) * io::rangeWindow(distance, light.range);
            sum += double(p.weight * e * (light.intensity.x + light.intensity.y + light.intensity.z));
        }
        if (const auto of = relevance.of(light.id)) {
            EXPECT_NEAR(*of, sum, 1e-3 * sum + 1e-4);
        }
        measured += relevance.of(light.id).has_value();
    }
    EXPECT_GT(measured, 20u);
}

// With a map for each light only the pixels between differ from the reference, and only at shadows' edges.
TEST(PunctualLighting, QuadsTakeTheirNeighboursShare) {
    const auto b = directBench(*scenegen::buildScene("lamps", 14), {320, 192});
    ASSERT_TRUE(applyPreset("lights-reference", b->settings));
    const Image reference = directImage(*b);
    ASSERT_TRUE(applyPreset("afterglow-lights", b->settings));
    b->settings.punctualLighting.quads = false;
    const Image each = directImage(*b);
    b->settings.punctualLighting.quads = true;
    const Image quads = directImage(*b);
    double own = 0, between = 0, scale = 0;
    for (size_t i = 0; i < quads.pixels.size(); ++i) {
        const size_t x = i % size_t(quads.width), y = i / size_t(quads.width);
        const glm::vec3 truth = reference.pixels[i];
        ASSERT_LT(glm::length(each.pixels[i] - truth), 1e-3f * (1 + glm::length(truth)))
            << "one light a cluster";
        const double off = double(glm::dot(quads.pixels[i] - truth, quads.pixels[i] - truth));
        (x % 2 || y % 2 ? between : own) += off / double(quads.pixels.size());
        scale += double(glm::dot(truth, truth)) / double(quads.pixels.size());
    }
    std::printf("quads: relative RMSE %.4f at their own pixels, %.4f between\n", std::sqrt(own / scale),
                std::sqrt(between / scale));
    EXPECT_LT(std::sqrt(own / scale), 1e-3);
    EXPECT_LT(std::sqrt(between / scale), 0.03);
}

// A cluster's shadow is that of a disk of light about its centre: behind a half-plane's edge the share of the
// disk above the edge.
TEST(PunctualShadows, PenumbraOfAClusterIsThatOfItsDisk) {
    scenegen::SceneBuilder s("edge");
    const uint32_t white = s.material("white", glm::vec3(0.7f));
    s.quad("floor", {-4, 0, -4}, {0, 0, 8}, {8, 0, 0}, white);
    s.quad("edge", {-4, 1, -4}, {0, 0, 8}, {4, 0, 0}, white);  // x < 0 at half the lights' height
    s.point("center", {0, 2, 0}, glm::vec3(10));
    const float radius = 0.3f;
    for (const glm::vec2 at : {glm::vec2(1, 0), glm::vec2(-1, 0), glm::vec2(0, 1), glm::vec2(0, -1)})
        s.point("rim", {radius * at.x, 2, radius * at.y}, glm::vec3(1e-4f));
    s.camera("camera", {0, 0.9f, 0}, {0.001f, 0, 0}, 80);
    const auto b = directBench(s.finish(), {128, 128});
    b->settings.lightClusters.most = 1;
    b->settings.lightClusters.strongFirst = false;  // the weak ones at the rim count
    b->settings.punctualShadows.softTaps = 32;
    b->settings.punctualLighting.shadowReach = 0;
    const Image shadowed = directImage(*b);
    for (RenderLight& light : b->scene.lights)
        light.castsShadow = false;
    ++b->scene.lightsVersion;
    const Image open = directImage(*b);
    const float half = 0.9f * std::tan(glm::radians(40.0f));
    double sum = 0;
    int count = 0;
    for (int i = 0; i < 128; ++i) {
        const glm::vec3 clip = glm::vec3(b->scene.camera.clipFromWorld * glm::vec4(0.2f, 0, 0, 1)) /
                               (b->scene.camera.clipFromWorld * glm::vec4(0.2f, 0, 0, 1)).w;
        const bool alongX = std::abs(clip.x) > std::abs(clip.y);
        const float sign = (alongX ? clip.x : clip.y) > 0 ? 1.0f : -1.0f;
        const float x = sign * ((float(i) + 0.5f) / 64 - 1) * half;
        const glm::ivec2 pixel = alongX ? glm::ivec2(i, 64) : glm::ivec2(64, i);
        const float t = glm::clamp(x / radius, -1.0f, 1.0f);
        const double truth =
            0.5 + (double(t) * std::sqrt(1 - double(t) * double(t)) + std::asin(double(t))) / kPi;
        const double lit = double(shadowed.at(pixel.x, pixel.y).x / open.at(pixel.x, pixel.y).x);
        sum += std::abs(lit - truth);
        ++count;
        if (std::abs(x) > 1.3f * radius) {
            EXPECT_NEAR(lit, truth, 0.02) << "at " << x;
        }
    }
    std::printf("penumbra: mean difference from the disk's share %.3f\n", sum / count);
    EXPECT_LT(sum / count, 0.05);
}

// Light falls through what a masked surface's texture cuts out.
TEST(PunctualShadows, CutOutPartsLetLightThrough) {
    scenegen::SceneBuilder s("screen");
    const uint32_t white = s.material("white", glm::vec3(0.5f)),
                   screen = s.material("screen", glm::vec3(0.5f));
    s.quad("floor", {-4, 0, -4}, {0, 0, 8}, {8, 0, 0}, white);
    s.quad("screen", {-4, 1, -4}, {0, 0, 8}, {8, 0, 0}, screen);
    s.point("lamp", {0, 3, 0}, glm::vec3(20));
    s.camera("camera", {0, 0.8f, 0}, {0.001f, 0, 0}, 80);
    SceneAsset asset = s.finish();
    cutOut(
        asset, screen, [](uint32_t x, uint32_t) { return x >= 128; },  // u < 1/2 is cut out
        [](glm::vec3 p) { return glm::vec2(p.x / 8 + 0.5f, 0.5f); });
    const auto b = directBench(std::move(asset), {64, 64});
    const Image lit = directImage(*b);
    int open = 0, shut = 0;
    for (int i = 4; i < 60; ++i) {
        const glm::vec4 h =
            b->scene.camera.worldFromClip * glm::vec4((float(i) + 0.5f) / 32 - 1, 0, 0.05f / 0.8f, 1);
        const glm::vec4 v =
            b->scene.camera.worldFromClip * glm::vec4(0, (float(i) + 0.5f) / 32 - 1, 0.05f / 0.8f, 1);
        const bool alongX = std::abs(h.x / h.w) > std::abs(v.x / v.w);
        const float x = alongX ? h.x / h.w : v.x / v.w, e = alongX ? lit.at(i, 32).x : lit.at(32, i).x;
        if (std::abs(x) < 0.1f) continue;
        (x < 0 ? open : shut) += 1;
        EXPECT_NEAR(e, x < 0 ? 20.0f / 9 : 0.0f, 0.25f) << "at " << x;
    }
    EXPECT_GT(open, 20);
    EXPECT_GT(shut, 20);
}

// Mean change of the lit image from frame to frame along a walk, relative to its mean.
double changeAlongAWalk(const char* preset, uint32_t clusters) {
    const auto b = directBench(*scenegen::buildScene("lamps", 80));
    EXPECT_TRUE(applyPreset(preset, b->settings));
    b->settings.lightClusters.most = clusters;
    CameraPose pose = cameraOf(b->asset, 0);
    const glm::dvec3 way(0.06, 0, -0.01);  // m a frame
    Image before;
    double change = 0, mean = 0;
    for (int step = 0; step < 40; ++step) {
        setCamera(b->scene, pose, b->size);
        pose.position += way;
        const Image now = directImage(*b);
        if (step < 4) {  // the lights are measured by then
            before = now;
            continue;
        }
        for (size_t i = 0; i < now.pixels.size(); ++i) {
            change += double(glm::length(now.pixels[i] - before.pixels[i]));
            mean += double(glm::length(now.pixels[i]));
        }
        before = now;
    }
    return change / mean;
}

TEST(PunctualLighting, ClustersDoNotPopAlongAWalk) {
    const double reference = changeAlongAWalk("lights-reference", kMostLightClusters);
    for (const uint32_t clusters : {10u, 26u}) {
        const double ours = changeAlongAWalk("afterglow-lights", clusters);
        const double published = changeAlongAWalk("lightcluster", clusters);
        std::printf("%u clusters: change a frame %.4f, published %.4f, a map each %.4f\n", clusters, ours,
                    published, reference);
        EXPECT_LT(ours, 1.1 * reference);
    }
}

TEST(PunctualLighting, WithoutLightsNoPassRuns) {
    const auto b = directBench(*scenegen::buildScene("lamps", 14));
    for (RenderLight& light : b->scene.lights)
        light.position.x -= 200;  // behind the camera and out of reach
    ++b->scene.lightsVersion;
    b->output = {};
    b->frame();
    for (const PassReport& pass : b->renderer.graph().report())
        EXPECT_FALSE(pass.name.starts_with("punctual_")) << pass.name;
}

// Lights come, go, move, flicker and blink for many frames, validation watching.
TEST(PunctualLighting, LightsMayChangeEveryFrame) {
    const auto b = directBench(*scenegen::buildScene("lamps", 80), {64, 40});
    const std::vector<RenderLight> all = b->scene.lights;
    for (uint32_t step = 0; step < 160; ++step) {
        b->scene.lights.clear();
        for (uint32_t i = 0; i < all.size(); ++i) {
            const uint32_t r = io::hashUint(step / 7 * 131 + i);
            if (r % 3 == 0) continue;
            RenderLight light = all[i];
            if (r % 5 == 0) light.intensity = glm::vec3(0);
            if (r % 7 == 0) light.position.y += 0.01f * float(step % 50);
            light.intensity *= 0.5f + io::hashToUnit(step * 977 + i);
            light.castsShadow = r % 11 != 0;
            b->scene.lights.push_back(light);
        }
        ++b->scene.lightsVersion;
        b->frame();
        if (step % 40 != 0) continue;
        for (const glm::vec3& p : readImage(b->renderer, b->last.direct.image).pixels)
            ASSERT_TRUE(std::isfinite(p.x + p.y + p.z));
    }
}

}  // namespace
}  // namespace ag::gi
