// Light that goes on after its first bounce: in a closed box every bounce carries the same share of the one
// before.
#include <gtest/gtest.h>

#include "common/brdf.h"
#include "tests/gi_gpu/bench.h"
#include "tools/reference/reference.h"
#include "tools/scenegen/scenes.h"

namespace ag::gi {
using namespace render;
namespace {

std::unique_ptr<Bench> laterBench(const char* scene, uint32_t param) {
    auto b = std::make_unique<Bench>(*scenegen::buildScene(scene, param), glm::uvec2(96, 54));
    b->settings.bounce.laterBounces.enabled = true;
    b->output = [](GraphScope scope, const RenderFrame& f) {
        if (f.bounce.irradiance.image) scope.output(f.bounce.irradiance.image);
    };
    return b;
}

// Mean over all surfaces by area, W/m².
double meanOnSurfaces(Bench& b) {
    const std::vector<io::RsmTexel> points = b.read<io::RsmTexel>(b.last.bounce.emitters.texels);
    const std::vector<glm::vec4> light = b.read<glm::vec4>(b.last.bounce.emitters.irradiance.current);
    double sum = 0, area = 0;
    for (size_t i = 0; i < points.size(); ++i) {
        sum += double(light[i].x) * double(points[i].area);
        area += double(points[i].area);
    }
    return sum / area;
}

double settledMean(uint32_t albedo, bool feedback) {
    const auto b = laterBench("furnace", albedo);
    b->settings.bounce.laterBounces.feedback = feedback;
    b->settings.bounce.ismAtlas.enabled = false;  // everything sees everything
    b->settings.bounce.texelRays.enabled = false;
    const int frames = feedback ? 70 : 36;  // its clusters come to rest after 32
    for (int i = 0; i < frames; ++i)
        b->frame();
    const double mean = meanOnSurfaces(*b);
    if (feedback && albedo == 90) {
        for (int i = 0; i < 60; ++i) {
            b->scene.lights[0].intensity.x = 1 + 1e-6f * float(i % 2);  // nothing may rest
            ++b->scene.lightsVersion;
            b->frame();
        }
        EXPECT_NEAR(meanOnSurfaces(*b) / mean, 1, 0.01) << "it stays";
    }
    return mean;
}

// Light that went on in the scene before must not be sent out in the one that takes its place.
TEST(LaterBounces, ASceneLoadedAnewHasNoneOfTheLightBefore) {
    const auto firstFrame = [](Bench& b) {
        b.frame();
        return readImage(b.renderer, b.last.bounce.irradiance.image);
    };
    const auto fresh = laterBench("furnace", 50), used = laterBench("furnace", 50);
    used->scene.lights[0].intensity *= 100.0f;
    for (int i = 0; i < 10; ++i)
        used->frame();
    used->scene.lights[0].intensity /= 100.0f;
    ++used->scene.lightsVersion;
    used->renderer.load(used->asset.geometry);
    const Image image = firstFrame(*used), truth = firstFrame(*fresh);
    ASSERT_GT(meanOf(truth), 0);
    EXPECT_EQ(meanOf(image), meanOf(truth));
}

TEST(LaterBounces, FurnaceConvergesToTheGeometricSeries) {
    const double power = 4 * 3.14159265 * 1, area = 24;  // W of the light, m²
    for (const uint32_t percent : {50u, 90u}) {
        const double rho = percent / 100.0, first = rho * power / area;
        const double one = settledMean(percent, false), all = settledMean(percent, true);
        std::printf("albedo %.1f: first bounce %.4f of the truth, all bounces %.4f\n", rho, one / first,
                    all / (first / (1 - rho)));
        EXPECT_NEAR(one / first, 1, 0.02);
        EXPECT_NEAR(all / (first / (1 - rho)), 1, 0.03);
    }
}

// Without shadow maps walls hide nothing: what each side of them gets would add up to more than was sent, and
// the loop of bounces would never end.
TEST(LaterBounces, WallsThatHideNothingMakeNoLight) {
    Bench b(*scenegen::buildScene("gallery", 0), {32, 18});
    b.settings.bounce.laterBounces.enabled = true;
    b.settings.bounce.ismAtlas.enabled = b.settings.bounce.texelRays.enabled = false;
    b.output = [](GraphScope scope, const RenderFrame& f) {
        scope.output(f.bounce.irradiance.image);
        scope.output(f.bounce.vals.vals);
    };
    for (int i = 0; i < 12; ++i)
        b.frame();
    const auto points = b.read<io::RsmTexel>(b.last.bounce.emitters.texels);
    const auto light = b.read<glm::vec4>(b.last.bounce.emitters.irradiance.current);
    double sent = 0, arrived = 0;
    for (const io::Val& val : b.read<io::Val>(b.last.bounce.vals.vals))
        sent += double(val.flux.x);
    for (size_t i = 0; i < light.size(); ++i)
        arrived += double(points[i].area * light[i].x);
    std::printf("%.1f W sent, %.1f W arrived\n", sent, arrived);
    EXPECT_GT(arrived, 0.5 * sent);
    EXPECT_LT(arrived, 1.001 * sent);
}

// Lobes reflect as much as they should, if not where to; of the Lambert part alone metal would reflect
// nothing.
TEST(LaterBounces, MetalPassesLightOn) {
    SceneAsset asset = *scenegen::buildScene("furnace", 50);
    for (Material& m : asset.geometry.materials)
        m.metallic = 1, m.roughness = 0.4f;
    const glm::vec3 base(asset.geometry.materials[0].baseColor);
    for (const bool whole : {true, false}) {
        Bench b(asset, {64, 36});
        b.settings.bounce.laterBounces.enabled = true;
        b.settings.bounce.ismAtlas.enabled = false;
        b.settings.bounce.texelRays.enabled = false;
        b.settings.bounce.valShading.glossy = whole;
        for (int i = 0; i < 70; ++i)
            b.frame();
        const double rho = whole ? double(io::wholeReflectance(base, 1, 0.4f, 1).x) : 0,
                     falls = 4 * 3.14159265 / 24, truth = falls * rho / (1 - rho);
        EXPECT_NEAR(meanOnSurfaces(b), truth, 0.03 * falls) << whole;
    }
}

TEST(LaterBounces, AreOfTheSurfacesOwnColourAndArea) {
    const auto b = laterBench("furnace", 50);
    b->frame();
    const std::vector<io::RsmTexel> points = b->read<io::RsmTexel>(b->last.bounce.emitters.texels);
    double area = 0;
    for (const io::RsmTexel& p : points) {
        area += double(p.area);
        const glm::vec3 a = glm::abs(p.position);
        EXPECT_NEAR(std::max(a.x, std::max(a.y, a.z)), 1, 1e-5) << "on a wall";
        EXPECT_NEAR(glm::dot(p.position, p.normal), -1, 1e-5) << "facing inwards";
    }
    EXPECT_NEAR(area, 24, 0.01);
}

TEST(LaterBounces, DoubleSidedSurfacesReflectToBothSides) {
    SceneAsset asset = *scenegen::buildScene("furnace", 50);
    for (Material& m : asset.geometry.materials)
        m.doubleSided = true;
    Bench b(asset, {16, 16});
    b.settings.bounce.laterBounces.enabled = true;
    b.frame();
    double inward = 0, outward = 0;
    for (const io::RsmTexel& p : b.read<io::RsmTexel>(b.last.bounce.emitters.texels))
        (glm::dot(p.position, p.normal) < 0 ? inward : outward) += double(p.area);
    EXPECT_NEAR(inward, 24, 0.2);
    EXPECT_NEAR(outward, 24, 0.2);
}

// With sheets that hang in the light, and things whose sides are narrower than what a point stands for.
TEST(LaterBounces, OfRoomsDrawnByChanceHaveThePathTracersLight) {
    for (const uint32_t which : {1u, 2u}) {
        Bench b(*scenegen::buildScene("room", which), {48, 27});
        b.settings.bounce.laterBounces.enabled = true;
        b.output = [](GraphScope scope, const RenderFrame& f) { scope.output(f.bounce.irradiance.image); };
        for (int i = 0; i < 160; ++i)
            b.frame();
        const double ours = meanOf(readImage(b.renderer, b.last.bounce.irradiance.image));
        JobRunner runner(2);
        const auto truth = reference::makeReference(
            reference::RayScene(b.scene), b.size,
            {.paths = {.bounces = 12}, .samplesPerPixel = 192, .layer = "indirect"}, runner, [](double) {});
        const double ratio = ours / meanOf(truth.indirect);
        std::printf("room %u: all bounces over path tracing's %.4f\n", which, ratio);
        EXPECT_NEAR(ratio, 1, 0.05);  // 0.86 and 0.91 of rooms like these before both sides reflected
    }
}

TEST(LaterBounces, CostNothingWhenOffAndRestWhenNothingChanges) {
    const auto b = laterBench("cornell", 0);
    b->settings.bounce.laterBounces.settleFrames = 8;
    for (int i = 0; i < 60; ++i)
        b->frame();
    EXPECT_EQ(b->passesRun(), 0) << "at rest";
    b->settings.bounce.laterBounces.enabled = false;
    b->frame();
    for (const PassReport& pass : b->renderer.graph().report())
        EXPECT_FALSE(pass.name.starts_with("later_bounces")) << pass.name;
    EXPECT_EQ(b->last.bounce.irradiance.image.index, b->last.bounce.bounce1.image.index);
}

// The dark undersides of the boxes face as the ceiling does and end up in its clusters; they must not pull
// the lights down to where the boxes cast no shadow.
TEST(LaterBounces, LightsOfTheCeilingLookFromTheCeiling) {
    const auto b = laterBench("cornell", 0);
    b->settings.bounce.valClustering.count = 256;
    b->output = [](GraphScope scope, const RenderFrame& f) { scope.output(f.bounce.vals.vals); };
    for (int i = 0; i < 64; ++i)
        b->frame();
    const std::vector<io::Val> vals = b->read<io::Val>(b->last.bounce.vals.vals);
    float ceiling = -1e9f;
    for (const io::RsmTexel& t : b->read<io::RsmTexel>(b->last.bounce.rsm.texels))
        if (t.weight > 0) ceiling = std::max(ceiling, t.position.y);
    int above = 0;
    for (size_t i = b->last.bounce.firstCount; i < vals.size(); ++i) {
        if (vals[i].flux == glm::vec3(0) || vals[i].normal.y > -0.99f) continue;
        if (vals[i].position.y < ceiling - 0.02f) continue;
        ++above;
        EXPECT_LT(vals[i].before, 0.2f) << "m, light " << i;
    }
    EXPECT_GT(above, 2);
}

TEST(LaterBounces, SameFrameTwiceSameBits) {
    std::vector<glm::vec4> first;
    for (int run = 0; run < 2; ++run) {
        const auto b = laterBench("cornell", 0);
        for (int i = 0; i < 12; ++i)
            b->frame();
        const std::vector<glm::vec4> light = b->read<glm::vec4>(b->last.bounce.emitters.irradiance.current);
        if (run == 0) first = light;
        EXPECT_TRUE(first == light);
    }
}

// Their light is gathered at fewer pixels, as nothing in it is fine.
TEST(LaterBounces, AtFewerPixelsAreWhatAllWouldHave) {
    Bench b(*scenegen::buildScene("cornell", 0), {320, 180});
    b.settings.bounce.laterBounces = {.enabled = true, .feedback = false};
    b.settings.bounce.texelRays.enabled = false;  // the first bounce is the same
    b.output = [](GraphScope scope, const RenderFrame& f) { scope.output(f.bounce.irradiance.image); };
    const auto settled = [&](uint32_t spacing) {
        b.settings.bounce.laterBounces.spacing = spacing;
        for (int frame = 0; frame < 80; ++frame)
            b.frame();
        return readImage(b.renderer, b.last.bounce.irradiance.image);
    };
    const Image truth = settled(1);
    for (const uint32_t spacing : {2u, 3u})
        expectAlike(settled(spacing), truth, spacing);
}

}  // namespace
}  // namespace ag::gi
