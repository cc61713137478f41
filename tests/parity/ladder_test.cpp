// The ladder's own evaluation of the renderer's lights against the renderer, and its truths against the
// reference.
#include "tools/bench/ladder.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "engine/scene/static_scene.h"
#include "tests/support/device_environment.h"
#include "tests/support/own_folder.h"
#include "tools/scenegen/scenes.h"

namespace ag::bench {
namespace {

struct Climbed {
    explicit Climbed(const char* name, const render::RenderSettings& settings = {})
        : asset(*scenegen::buildScene(name, 0)),
          scene(staticScene(asset)),
          hits(size),
          renderer(test::device()) {
        setCamera(scene, cameraOf(asset, 0), size);
        const reference::RayScene rays(scene);
        JobRunner runner(2);
        uint64_t count = 0;
        reference::traceFirstHits(rays, {}, {}, runner, hits, count);
        auto read = readAreaLights(renderer, scene, size, settings);
        EXPECT_TRUE(read);
        set = std::move(*read);
        images = climbLadder(rays, hits, set, settings.bounce, runner);
    }
    ImageDifference differ(Stage truth, Stage test) const {
        return *compareImages(images.of(truth), images.of(test));
    }
    glm::uvec2 size{64, 36};
    SceneAsset asset;
    RenderScene scene;
    reference::FirstHits hits;
    render::Renderer renderer;
    AreaLightSet set;
    LadderImages images;
};

// All pixels gathered, so that nothing is brought from one to another.
TEST(Ladder, EveryPixelIsWhatTheRendererMakes) {
    for (const char* name : {"cornell", "occluder", "corridor"}) {
        render::RenderSettings settings;
        settings.bounce.spacing = 1;
        settings.bounce.texelRays.enabled = false;  // the ladder has none
        const Climbed c(name, settings);
        const ImageDifference d = c.differ(Stage::kRendered, Stage::kEveryPixel);
        std::printf("%s: mean ratio %.4f, relative RMSE %.4f\n", name, d.meanRatio, d.relativeRmse);
        EXPECT_NEAR(d.meanRatio, 1, 0.005) << name;
        EXPECT_LT(d.trimmedRelativeRmse, 0.02) << name;
    }
}

TEST(Ladder, TexelsCarryTheLightsFlux) {
    const Climbed c("cornell");
    glm::dvec3 texels(0), lights(0);
    for (const AreaLightRead& l : c.set.lights) {
        lights += glm::dvec3(l.val.flux);
        for (const io::RsmTexel& t : c.set.texelsOf(l))
            texels += glm::dvec3(t.flux);
    }
    for (int channel = 0; channel < 3; ++channel)
        EXPECT_NEAR(texels[channel] / lights[channel], 1, 1e-3);
}

// Where nothing stands between, each light sees all it shines on.
TEST(Ladder, AnOpenCornerHasNoShadows) {
    const Climbed c("corner");
    for (const Stage stage : {Stage::kCentreRay, Stage::kTexelRays}) {
        const ImageDifference d = c.differ(Stage::kEveryPixel, stage);
        EXPECT_NEAR(d.meanRatio, 1, 0.01);
        EXPECT_LT(d.trimmedRelativeRmse, 0.02);
    }
}

TEST(Ladder, EachStepIsNearerToTheReference) {
    const SceneAsset asset = *scenegen::buildScene("occluder", 0);
    RenderScene scene = staticScene(asset);
    LadderOptions options{.size = {96, 54}, .clusterings = 1};
    options.reference = {.samplesPerPixel = 4096, .maxError = 0.02, .layer = "bounce1"};
    setCamera(scene, cameraOf(asset, 0), options.size);
    ReferenceCache cache(test::ownFile("ladder"));
    JobRunner runner(2);
    const auto ladder = measureLadder(test::device(), scene, options, cache, runner, [](double) {});
    ASSERT_TRUE(ladder);
    const auto error = [&](Stage s) { return ladder->errors[size_t(s)]; };
    std::fputs(ladderToMarkdown(*ladder, "test").c_str(), stdout);
    EXPECT_LT(error(Stage::kTexels).toneRmse, error(Stage::kTexelRays).toneRmse);
    EXPECT_LT(error(Stage::kTexelRays).toneRmse, error(Stage::kEveryPixel).toneRmse);
    EXPECT_NEAR(error(Stage::kTexels).meanRatio, 1, 0.01);
    EXPECT_LT(error(Stage::kTexels).trimmedRelativeRmse, 0.02);
}

}  // namespace
}  // namespace ag::bench
