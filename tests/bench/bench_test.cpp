// The benchmark's own arithmetic and its files; measuring itself is tested by running it.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "engine/core/safe_file.h"
#include "engine/core/settings.h"
#include "engine/renderer/debug_view.h"
#include "engine/renderer/render_settings.h"
#include "engine/scene/static_scene.h"
#include "tests/support/own_folder.h"
#include "tools/bench/moving_light.h"
#include "tools/bench/path_tracing.h"
#include "tools/bench/report.h"
#include "tools/bench/row_cache.h"
#include "tools/bench/techniques.h"
#include "tools/bench/walking.h"
#include "tools/scenegen/scenes.h"

namespace ag::bench {
namespace {

Row row(const char* technique, double ms, double error) {
    Row r;
    r.scene = "room";
    r.technique = technique;
    r.term = "bounce1";
    r.size = {64, 36};
    r.gpuMsMedian = ms;
    r.error.relativeRmse = error;
    r.pathTracingRelRmse = 2;
    return r;
}

TEST(Bench, ParetoFrontHasOnlyWhatNothingBeats) {
    Report report{.rows = {row("a", 10, 0.3), row("b", 20, 0.2), row("c", 25, 0.25), row("d", 5, 0.5),
                           row("e", 10, 0.3)}};
    report.rows.push_back(row("path-tracing", 1, 0.01));
    Row elsewhere = row("c", 1, 0.01);
    elsewhere.scene = "hall";
    report.rows.push_back(elsewhere);
    markPareto(report);
    const std::vector<bool> expected = {true, true, false, true, true, false, true};
    for (size_t i = 0; i < expected.size(); ++i)
        EXPECT_EQ(report.rows[i].pareto, expected[i]) << i;
}

TEST(Bench, FilesHoldEveryRow) {
    Report report{.device = "a \"device\"",
                  .driver = "driver",
                  .commit = "abc",
                  .rows = {row("a", 10, 0.3), row("b", 20, 0.2)}};
    markPareto(report);
    const auto json = nlohmann::json::parse(toJson(report));
    ASSERT_EQ(json["rows"].size(), 2u);
    for (const char* field :
         {"scene",         "technique",      "settings",        "size",     "vals",      "gpu_ms_median",
          "gpu_ms_p99",    "cpu_ms_median",  "passes",          "skipped",  "gpu_bytes", "term",
          "mean_ratio",    "rel_rmse",       "rel_mse",         "p99",      "flip",      "noise_floor",
          "flicker_still", "flicker_moving", "flicker_walking", "ghosting", "tone_rmse", "rel_rmse_trimmed",
          "median_rel",    "leak_pixels"})
        EXPECT_TRUE(json["rows"][0].contains(field)) << field;
    EXPECT_TRUE(json["rows"][0]["flicker_still"].is_null()) << "not measured is not 0";
    std::istringstream csv(toCsv(report));
    std::string header, line;
    std::getline(csv, header);
    int lines = 0;
    while (std::getline(csv, line)) {
        EXPECT_EQ(std::count(line.begin(), line.end(), ','), std::count(header.begin(), header.end(), ','));
        ++lines;
    }
    EXPECT_EQ(lines, 2);
    const std::string svg = toSvg(report);
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    EXPECT_EQ(svg.find("inf"), std::string::npos);
    EXPECT_NE(svg.find("room"), std::string::npos);
    EXPECT_NE(svg.find("</svg>"), std::string::npos);
    EXPECT_NE(toSvg({}).find("</svg>"), std::string::npos) << "an empty report is a chart, too";
    EXPECT_NE(toMarkdown(report).find("| b ★ |"), std::string::npos);
}

// An error that was all noise is 0, which a logarithmic axis cannot show.
TEST(Bench, ChartLeavesOutErrorsOfZero) {
    const std::string svg = toSvg({.rows = {row("a", 10, 0), row("a", 20, 0.2), row("path-tracing", 10, 0)}});
    EXPECT_EQ(svg.find("inf"), std::string::npos);
    EXPECT_LT(svg.size(), 20'000u);
}

TEST(Bench, EveryTechniqueIsAPresetWithValidSettings) {
    for (const Technique& technique : techniques()) {
        ASSERT_FALSE(technique.variants.empty());
        if (technique.runner != Runner::kGpu) continue;
        render::RenderSettings settings;
        Settings registry;
        render::registerSettings(registry, settings);
        const std::string_view preset = technique.preset.empty() ? technique.name : technique.preset;
        EXPECT_TRUE(render::applyPreset(preset, settings)) << technique.name;
        for (const Variant& variant : technique.variants)
            for (const std::string& assignment : variant.settings)
                EXPECT_TRUE(registry.set(assignment)) << assignment;
    }
}

TEST(Bench, FlickerOfKnownSequences) {
    std::vector<Image> steady(8, Image(4, 4)), blinking(8, Image(4, 4));
    for (size_t f = 0; f < 8; ++f)
        for (size_t i = 0; i < 16; ++i) {
            steady[f].pixels[i] = glm::vec3(2);
            blinking[f].pixels[i] = glm::vec3(f % 2 ? 3.0f : 1.0f);
        }
    EXPECT_EQ(flickerOf(steady, nullptr), 0);
    EXPECT_NEAR(flickerOf(blinking, nullptr), 0.5, 1e-6) << "deviation 1 about a mean of 2";
}

TEST(Bench, WalksKnowNoiseFromGhosts) {
    std::vector<Image> standing(8, Image(32, 32)), noisy = standing, trailing = standing;
    for (size_t f = 0; f < 8; ++f)
        for (size_t i = 0; i < 32 * 32; ++i) {
            standing[f].pixels[i] = glm::vec3(2);
            noisy[f].pixels[i] = glm::vec3((i + i / 32 + f) % 2 ? 3.0f : 1.0f);
            trailing[f].pixels[i] = glm::vec3(2.5f);
        }
    const Walking same = compareWalk(standing, standing), noise = compareWalk(noisy, standing),
                  trail = compareWalk(trailing, standing);
    EXPECT_EQ(same.flicker, 0);
    EXPECT_EQ(same.ghosting, 0);
    EXPECT_NEAR(noise.flicker, 0.5, 1e-6);
    EXPECT_LT(noise.ghosting, 0.03);
    EXPECT_NEAR(trail.flicker, 0, 1e-6);
    EXPECT_NEAR(trail.ghosting, 0.25, 1e-6);
}

TEST(Bench, TrendTakesTheTruthsOwnMotionAway) {
    const SceneAsset asset = *scenegen::buildScene("cornell", 0);
    RenderScene scene = staticScene(asset);
    const glm::uvec2 size(16, 9);
    setCamera(scene, cameraOf(asset, 0), size);
    const std::string folder = test::ownFile("references");
    ReferenceCache cache(folder);
    JobRunner runner(2);
    const auto silent = [](double) {};
    const reference::ReferenceSettings settings{
        .paths = {.litPoints = false}, .samplesPerPixel = 64, .layer = "bounce1"};
    const auto trend = ReferenceTrend::make(cache, scene, size, settings, runner, silent);
    ASSERT_TRUE(trend);
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), 5) << "each key is kept";
    std::vector<Image> frames;
    for (uint32_t f = 0; f < 9; ++f) {
        RenderScene moved = scene;
        moved.lights = movedLights(scene, f / 8.0);
        frames.push_back(*cache.get(moved, size, settings, runner, silent));
    }
    EXPECT_LT(flickerOf(frames, &*trend), 0.3 * flickerOf(frames, nullptr));
}

TEST(Bench, TwoReferencesHaveTheNoiseOfTheirMean) {
    const SceneAsset asset = *scenegen::buildScene("corner", 0);
    RenderScene scene = staticScene(asset);
    const glm::uvec2 size(32, 18);
    setCamera(scene, cameraOf(asset, 0), size);
    const std::string folder = test::ownFile("references");
    ReferenceCache cache(folder);
    JobRunner runner(2);
    const reference::ReferenceSettings settings{
        .samplesPerPixel = 4096, .maxError = 0.02, .layer = "bounce1"};
    const auto two = cache.getTwo(scene, size, settings, runner, [](double) {});
    ASSERT_TRUE(two);
    EXPECT_NE(two->a.pixels, two->b.pixels);
    EXPECT_GT(two->noise, 0.005);
    EXPECT_LT(two->noise, 0.03);
    const auto ofOne = compareImages(two->a, two->b);
    EXPECT_NEAR(ofOne->relativeRmse, 2 * two->noise, 0.2 * two->noise)
        << "the difference of both is twice that";
}

TEST(Bench, CacheKnowsWhatAReferenceDependsOn) {
    const SceneAsset asset = *scenegen::buildScene("cornell", 0);
    RenderScene scene = staticScene(asset);
    const uint64_t before = sceneHash(scene);
    EXPECT_EQ(before, sceneHash(staticScene(asset)));
    scene.lights[0].intensity.x += 1;
    EXPECT_NE(before, sceneHash(scene));
    SceneAsset painted = asset;
    painted.geometry.materials[0].baseColor.x += 0.1f;
    EXPECT_NE(before, sceneHash(staticScene(painted)));
    RenderScene nudged = staticScene(asset);
    nudged.instances[0].worldFromLocal[3].x += 1e-3f;
    EXPECT_NE(before, sceneHash(nudged));
}

TEST(Bench, RowsAreKeptAsTheyWere) {
    const std::string folder = test::ownFile("rows");
    Row row{.scene = "cornell",
            .technique = "afterglow",
            .variant = "128",
            .size = {64, 36},
            .vals = 128,
            .term = "bounce1"};
    row.settings["val_clustering.count"] = "128";
    row.passes["rsm.render"] = 1.5;
    row.gpuMsMedian = 30.25, row.gbufferMs = 2.5, row.error.relativeRmse = 0.047, row.flickerMoving = 0.01;
    Row paths = row;
    paths.technique = kPathTracing;
    const RowCache cache(folder);
    EXPECT_FALSE(cache.find(7));
    cache.keep(7, {row, paths});
    const auto back = cache.find(7);
    ASSERT_TRUE(back);
    EXPECT_EQ(toJson({.rows = *back}), toJson({.rows = {row, paths}}));
    EXPECT_EQ(toCsv({.rows = *back}), toCsv({.rows = {row, paths}}));
    EXPECT_FALSE((*back)[0].flickerStill);
    EXPECT_FALSE(cache.find(8));
    // A damaged row is measured anew.
    ASSERT_TRUE(writeFileSafely(folder + "/row-0000000000000007.json", "[{\"scene\": 3}]"));
    EXPECT_FALSE(cache.find(7));
    EXPECT_EQ(RowCache::programHash(), RowCache::programHash());
}

TEST(Bench, PathTracingsErrorBetweenTheTimesItWasLookedAt) {
    const std::vector<Row> curve = {row("path-tracing", 10, 0.8), row("path-tracing", 40, 0.4)};
    EXPECT_NEAR(errorAfter(curve, 20), 0.8 / std::sqrt(2.0), 1e-6) << "halfway in logarithms";
    EXPECT_NEAR(errorAfter(curve, 10), 0.8, 1e-6);
    EXPECT_NEAR(errorAfter(curve, 5), 0.8, 1e-6) << "less than one pass";
    EXPECT_NEAR(errorAfter(curve, 160), 0.2, 1e-6) << "by the root of time";
    EXPECT_EQ(errorAfter({}, 10), 0);
}

TEST(Bench, PathTracingGetsBetterWithTime) {
    const SceneAsset asset = *scenegen::buildScene("cornell", 0);
    RenderScene scene = staticScene(asset);
    constexpr glm::uvec2 kSize{32, 18};
    setCamera(scene, cameraOf(asset, 0), kSize);
    const reference::RayScene rays(scene);
    JobRunner runner(2);
    const auto trace = [&](uint32_t seed) {
        return reference::makeReference(
            rays, kSize, {.samplesPerPixel = 256, .seed = seed, .layer = "bounce1"}, runner, [](double) {});
    };
    const reference::Reference a = trace(1), b = trace(2);
    const std::vector<Row> curve =
        tracePathCurve(rays, {}, "bounce1", {a.bounces[1], b.bounces[1]}, runner, 6);
    ASSERT_EQ(curve.size(), 6u);
    EXPECT_LT(curve.back().error.relativeRmse, curve.front().error.relativeRmse);
    for (const Row& row : curve)
        EXPECT_TRUE(row.isPathTracing() && row.flip > 0 && row.size == kSize) << row.variant;
}

// A term is a layer of both, so that errors can be measured on it.
TEST(Bench, TermsAreLayersOfRendererAndReference) {
    for (const std::string_view term : terms()) {
        EXPECT_TRUE(render::layerFromName(layerOfTerm(term))) << term;
        EXPECT_TRUE(reference::checkLayer(layerOfTerm(term), bouncesOfTerm(term))) << term;
    }
    for (const Technique& t : techniques())
        EXPECT_TRUE(isTerm(t.term)) << t.name;
    EXPECT_GE(bouncesOfTerm("all"), 16u);
}

}  // namespace
}  // namespace ag::bench
