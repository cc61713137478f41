// Probes against the path tracer at the same points.
#include <gtest/gtest.h>

#include <cmath>

#include "bench.h"
#include "common/sampling.h"
#include "tools/reference/path_tracer.h"
#include "tools/scenegen/builder.h"
#include "tools/scenegen/scenes.h"

namespace ag::gi {
using namespace render;
namespace {

// Irradiance of one bounce or of more, and straight from lights, on a small plane at each point.
std::vector<ProbeReading> reference(const RenderScene& scene, std::span<const RenderProbe> planes,
                                    uint32_t samples, uint32_t bounces = 1) {
    const reference::RayScene rays(scene);
    JobRunner runner(2);
    reference::FirstHits hits({uint32_t(planes.size()), 1});
    for (size_t i = 0; i < planes.size(); ++i) {
        reference::Surface& s = hits.surfaces[i];
        s.position = planes[i].position;
        s.normal = s.geometricNormal = planes[i].normal;
        s.distance = 1;
        s.resolved = true;
        s.albedo = glm::vec3(1);
        hits.directions[i] = -planes[i].normal;
    }
    reference::LightSums sums(hits.size, bounces);
    reference::addPaths(rays, hits, {.bounces = bounces}, {.seed = 7, .count = samples}, runner, sums);
    std::vector<ProbeReading> out(planes.size());
    for (size_t i = 0; i < planes.size(); ++i) {
        out[i].bounced = (bounces > 1 ? sums.indirect : sums.bounces[1]).pixels[i] / float(samples);
        for (const reference::PreparedLight& p : rays.lights()) {
            const glm::vec3 d = p.light.position - planes[i].position;
            const float distance = glm::length(d), cosine = glm::dot(planes[i].normal, d) / distance;
            const float cone = -glm::dot(d, p.light.direction) / distance;
            if (cosine <= 0 || !rays.visible(planes[i].position, d / distance, distance)) continue;
            const float t = p.light.kind == LightKind::kSpot
                                ? glm::clamp((cone - p.cosOuter) / (p.cosInner - p.cosOuter), 0.0f, 1.0f)
                                : 1.0f;
            out[i].direct += p.light.intensity * (t * t * cosine / (distance * distance));
        }
    }
    return out;
}

float luminance(glm::vec3 e) {
    return (e.x + e.y + e.z) / 3;
}

void measure(Bench& b, std::vector<RenderProbe> probes, int frames) {
    for (size_t i = 0; i < probes.size(); ++i)
        probes[i].id = 100 + i;
    b.scene.probes = std::move(probes);
    ++b.scene.probesVersion;
    for (int i = 0; i < frames; ++i)
        b.frame();
}

// Relative error of bounced light, over all probes together and of the worst that gets a fair share.
void compare(const char* name, Bench& b, std::span<const RenderProbe> probes,
             std::span<const ProbeReading> truth, double mostMean, double mostWorst) {
    double error = 0, sum = 0, worst = 0, most = 0;
    for (const ProbeReading& t : truth)
        most = std::max(most, double(luminance(t.bounced)));
    for (size_t i = 0; i < probes.size(); ++i) {
        const auto known = b.renderer.probeReadings().of(100 + i);
        ASSERT_TRUE(known) << name;
        const double off = std::abs(double(luminance(known->bounced - truth[i].bounced)));
        error += off;
        sum += double(luminance(truth[i].bounced));
        if (double(luminance(truth[i].bounced)) > 0.2 * most)
            worst = std::max(worst, off / double(luminance(truth[i].bounced)));
        const float direct = luminance(truth[i].direct);
        EXPECT_NEAR(luminance(known->direct), direct, 0.04f * direct + 1e-3f) << name << " probe " << i;
    }
    std::printf("%s: bounced light off by %.3f in the mean, %.3f at worst\n", name, error / sum, worst);
    EXPECT_LT(error / sum, mostMean) << name;
    EXPECT_LT(worst, mostWorst) << name;
}

std::vector<RenderProbe> grid(glm::vec3 from, glm::vec3 to, glm::vec3 normal) {
    std::vector<RenderProbe> out;
    for (int z = 0; z < 3; ++z)
        for (int x = 0; x < 4; ++x)
            out.push_back({.position = glm::mix(from, to, glm::vec3(float(x) / 3, 0.5f, float(z) / 2)),
                           .normal = normal});
    return out;
}

TEST(Probes, MeasureWhatThePathTracerMeasures) {
    struct Case {
        const char* scene;
        glm::vec3 from, to, normal;
    };
    for (const Case& c : {Case{"cornell", {-0.7f, 1.3f, -0.7f}, {0.7f, 1.7f, 0.8f}, {0, -1, 0}},
                          Case{"cornell", {-0.8f, 0.3f, 0.75f}, {0.8f, 0.5f, 0.9f}, {0, 0, -1}},
                          Case{"occluder", {-1.7f, 0.6f, -1}, {-0.9f, 1.6f, 1}, {-1, 0, 0}}}) {
        Bench b(*scenegen::buildScene(c.scene, 0));
        b.settings.bounce.rsm.resolution = 0;  // as the light says: direct light goes by it
        const std::vector<RenderProbe> probes = grid(c.from, c.to, c.normal);
        const auto truth = reference(b.scene, probes, 4096);
        measure(b, probes, 40);  // settled
        compare(c.scene, b, probes, truth, 0.012, 0.04);
        b.settings.bounce.probes.rays = 0;
        measure(b, probes, 3);                           // read back two frames later
        compare(c.scene, b, probes, truth, 0.10, 0.35);  // worst: in the penumbra of a block near by
    }
}

// Right beside surfaces, too, for which few points of later bounces stand.
TEST(Probes, MeasureAllBounces) {
    struct Case {
        const char* scene;
        glm::vec3 from, to, normal;
    };
    for (const Case& c : {Case{"cornell", {-0.95f, 0.1f, 0.75f}, {0.95f, 0.5f, 0.9f}, {0, 0, -1}},
                          Case{"occluder", {-1.7f, 0.6f, -1}, {-0.9f, 1.6f, 1}, {1, 0, 0}}}) {
        Bench b(*scenegen::buildScene(c.scene, 0), {48, 27});  // which does not matter to probes
        b.settings.bounce.rsm.resolution = 0;
        addBounces(b.settings);
        const std::vector<RenderProbe> probes = grid(c.from, c.to, c.normal);
        const auto truth = reference(b.scene, probes, 4096, 12);
        measure(b, probes, 32);
        compare(c.scene, b, probes, truth, 0.06, 0.15);
    }
}

// While a light moves, probes have no rays of rest; what the last frames' rays found corrects the area
// lights.
TEST(Probes, FollowALightThatMoves) {
    Bench b(*scenegen::buildScene("cornell", 0));
    b.settings.bounce.rsm.resolution = 0;
    const std::vector<RenderProbe> probes = grid({-0.8f, 0.3f, 0.75f}, {0.8f, 0.5f, 0.9f}, {0, 0, -1});
    measure(b, probes, 20);
    RenderLight& light = b.scene.lights[0];
    const auto move = [&](float by) {
        light.intensity *= by;
        light.position.z += 0.002f;
        ++b.scene.lightsVersion;
        b.frame();
    };
    for (int i = 0; i < 20; ++i)
        move(1);
    const RenderScene then = b.scene;
    move(3);  // read back in two frames
    move(1);
    compare("a light that moved", b, probes, reference(then, probes, 4096), 0.05, 0.15);
    const RenderScene brighter = b.scene;
    move(1), move(1);
    compare("that became three times as bright", b, probes, reference(brighter, probes, 4096), 0.08, 0.3);
}

// What a settled probe has does not depend on where the camera looks, though the area lights do.
TEST(Probes, LightDoesNotDependOnTheCamera) {
    Bench b(*scenegen::buildScene("cornell", 0));
    b.settings.bounce.probes.settleFrames = 30;
    const std::vector<RenderProbe> probes = {{.position = {0.3f, 1, 0.5f}}};
    measure(b, probes, 34);
    const ProbeReading before = *b.renderer.probeReadings().of(100);
    CameraPose pose = cameraOf(b.asset, 0);
    for (int i = 0; i < 6; ++i) {
        pose.position.x += 0.1;
        setCamera(b.scene, pose, b.size);
        b.frame();
    }
    EXPECT_EQ(*b.renderer.probeReadings().of(100), before);
}

// Behind the slab one place in a thousand of the lit wall's light arrives.
TEST(Probes, WallsBetweenKeepBouncedLightOut) {
    Bench b(*scenegen::buildScene("occluder", 0));
    std::vector<RenderProbe> probes = grid({0.1f, 0.4f, -1}, {1.6f, 0.9f, 1}, {-1, 0, 0});
    probes.push_back({.position = {-1.4f, 1.1f, 0}, .normal = {-1, 0, 0}});
    measure(b, probes, 40);  // settled
    const float lit = luminance(b.renderer.probeReadings().of(100 + probes.size() - 1)->bounced);
    EXPECT_GT(lit, 0.5f);
    for (size_t i = 0; i + 1 < probes.size(); ++i) {
        EXPECT_LT(luminance(b.renderer.probeReadings().of(100 + i)->bounced), 0.002f * lit);
        EXPECT_EQ(b.renderer.probeReadings().of(100 + i)->direct, glm::vec3(0));
    }
}

// A probe without a normal has the mean over all directions.
TEST(Probes, AllRoundIsTheMeanOverDirections) {
    Bench b(*scenegen::buildScene("cornell", 0));
    const std::vector<glm::vec3> places = {{-0.6f, 1.5f, 0.2f}, {0.5f, 1.2f, 0.5f}, {0, 0.9f, 0.8f}};
    std::vector<RenderProbe> probes, planes;
    constexpr int kDirections = 64;
    for (const glm::vec3 place : places) {
        probes.push_back({.position = place});
        for (int i = 0; i < kDirections; ++i) {
            const float z = 1 - (2 * float(i) + 1) / kDirections, r = std::sqrt(1 - z * z),
                        phi = 2.3999632f * float(i);
            planes.push_back({.position = place, .normal = {r * std::cos(phi), z, r * std::sin(phi)}});
        }
    }
    const auto byPlane = reference(b.scene, planes, 1024);
    std::vector<ProbeReading> truth(places.size());
    for (size_t i = 0; i < byPlane.size(); ++i) {
        truth[i / kDirections].bounced += byPlane[i].bounced / float(kDirections);
        truth[i / kDirections].direct += byPlane[i].direct / float(kDirections);
    }
    measure(b, probes, 40);  // settled
    compare("cornell, all round", b, probes, truth, 0.02, 0.05);
}

// A hall of 60 m, a glowing square in it; and a dark sheet 0.8 mm before that.
SceneAsset behindASheet(bool sheet) {
    scenegen::SceneBuilder s("sheet");
    const uint32_t dark = s.material("dark", glm::vec3(0.02f));
    s.room("hall", {-30, -5, -30}, {30, 5, 30}, {dark, dark, dark, dark, dark, dark});
    s.quad("square", {-1, -1, -1}, {2, 0, 0}, {0, 2, 0}, s.emissive("glow", glm::vec3(0.5f), glm::vec3(5)));
    if (sheet) s.quad("sheet", {-2, -2, -0.9992f}, {4, 0, 0}, {0, 4, 0}, dark);
    s.camera("camera", {0, 0, 2}, {0, 0, 0}, 60);
    return s.finish();
}

TEST(Probes, NothingRightBehindASheetIsSeen) {
    std::array<float, 2> light{};
    for (const bool sheet : {false, true}) {
        Bench b(behindASheet(sheet), {32, 18});
        measure(b, {{.position = {0, 0, 0}, .normal = {0, 0, -1}}}, 60);
        light[sheet] = luminance(b.renderer.probeReadings().of(100)->bounced);
    }
    // A square 1 m away, twice as wide: 0.554 of what a whole hemisphere would send.
    EXPECT_NEAR(light[0], 0.554f * 5 * float(kPi), 0.03f * 5 * float(kPi));
    EXPECT_LT(light[1], 0.01f * light[0]);
}

TEST(Probes, WithoutAnyNothingIsDone) {
    Bench b(*scenegen::buildScene("cornell", 0));
    for (int i = 0; i < 4; ++i)
        b.frame();
    for (const PassReport& pass : b.renderer.graph().report())
        EXPECT_NE(pass.name.substr(0, 6), "probes");
    EXPECT_EQ(b.renderer.probeReadings().count(), 0u);
}

TEST(Probes, AreKnownTwoFramesLaterAndRestWhenNothingMoves) {
    Bench b(*scenegen::buildScene("cornell", 0));
    b.settings.bounce.valClustering.settleFrames = b.settings.bounce.probes.settleFrames = 4;
    const std::vector<RenderProbe> probes = {{.position = {0, 1, 0.5f}}};
    measure(b, probes, 1);
    EXPECT_FALSE(b.renderer.probeReadings().of(100));
    b.frame();
    EXPECT_FALSE(b.renderer.probeReadings().of(100));
    b.frame();
    EXPECT_TRUE(b.renderer.probeReadings().of(100));
    for (int i = 0; i < b.restFrames(); ++i)
        b.frame();
    EXPECT_EQ(b.passesRun(), 0) << "nothing moved";
    EXPECT_TRUE(b.renderer.probeReadings().of(100));
    // The light goes out: its reading does not stay behind.
    b.scene.lights.clear();
    ++b.scene.lightsVersion;
    b.frame();
    EXPECT_EQ(b.renderer.probeReadings().of(100)->bounced, glm::vec3(0));
}

}  // namespace
}  // namespace ag::gi
