// Surfaces that blend with what is behind them: in the part of the picture where they are, at no cost
// elsewhere. Against path tracing: Parity.SurfacesThatBlend.
#include "engine/renderer/blended_layers.h"
#include "tests/gi_gpu/bench.h"
#include "tools/scenegen/builder.h"
#include "tools/scenegen/scenes.h"

namespace ag::gi {
namespace {

TEST(BlendedLayers, AWindowSeesThatPartOfThePicture) {
    const SceneAsset asset = *scenegen::buildScene("panes", 0);
    RenderScene scene = staticScene(asset);
    const glm::uvec2 picture(160, 90);
    setCamera(scene, cameraOf(asset, 0), picture);
    const PictureWindow window{{32, 64}, {80, 23}};
    const RenderCamera part = windowed(scene.camera, picture, window);
    const auto pixelOf = [](const RenderCamera& camera, glm::uvec2 size, glm::vec3 place) {
        const glm::vec4 h = camera.clipFromWorld * glm::vec4(place, 1);
        return glm::vec3((glm::vec2(h) / h.w * 0.5f + 0.5f) * glm::vec2(size), h.z / h.w);
    };
    for (const glm::vec3 place : {glm::vec3(0, 1, -2), glm::vec3(2.5f, 0, 1), glm::vec3(-3, 2, -1)}) {
        const glm::vec3 whole = pixelOf(scene.camera, picture, place);
        const glm::vec3 own = pixelOf(part, window.size, place);
        EXPECT_NEAR(whole.x, own.x + 32, 1e-3f);
        EXPECT_NEAR(whole.y, own.y + 64, 1e-3f);
        EXPECT_EQ(whole.z, own.z) << "depths of both compare";
        const glm::vec4 clip(0.3f, -0.2f, 0.01f, 1);
        const glm::vec4 back = part.clipFromWorld * (part.worldFromClip * clip);
        EXPECT_NEAR(back.x / back.w, clip.x, 1e-3f);
        EXPECT_NEAR(back.y / back.w, clip.y, 1e-3f);
    }
}

// A sheet that covers half of a shining wall, and glass of one colour before the other half.
TEST(BlendedLayers, CoverAndTintAsTheirMaterialsSay) {
    scenegen::SceneBuilder b("sheets");
    b.quad("wall", {-2, -2, -1}, {4, 0, 0}, {0, 4, 0}, b.emissive("shining", glm::vec3(0), {2, 3, 4}));
    const uint32_t sheet = b.emissive("sheet", glm::vec3(0), {8, 0, 0}),
                   glass = b.material("glass", {0.5f, 0.8f, 1});
    for (const uint32_t m : {sheet, glass})
        b.materialAt(m).alphaMode = AlphaMode::kBlend;
    b.materialAt(sheet).baseColor.w = 0.25f;
    b.materialAt(glass).transmission = 1;
    b.quad("sheet", {-1, -1, 0}, {0.9f, 0, 0}, {0, 2, 0}, sheet);
    b.quad("glass", {0.1f, -1, 0}, {0.9f, 0, 0}, {0, 2, 0}, glass);
    b.camera("camera", {0, 0, 3}, {0, 0, 0}, 45);
    Bench bench(b.finish(), {96, 64});
    bench.settings.technique = Technique::kNone;
    bench.frame();
    const Image image = readImage(bench.renderer, bench.last.outputs.radiance);
    const auto near = [](glm::vec3 seen, glm::vec3 wanted) { return glm::length(seen - wanted) < 0.01f; };
    const auto at = [&](int x) { return image.pixels[size_t(32 * 96 + x)]; };
    EXPECT_TRUE(near(at(34), 0.75f * glm::vec3(2, 3, 4) + 0.25f * glm::vec3(8, 0, 0)));
    EXPECT_TRUE(near(at(62), glm::vec3(2, 3, 4) * glm::vec3(0.5f, 0.8f, 1)));
    EXPECT_TRUE(near(at(48), glm::vec3(2, 3, 4))) << "between them";
    EXPECT_TRUE(near(at(20), glm::vec3(2, 3, 4))) << "outside of the window";
    bench.settings.blending.layers = 0;
    bench.frame();
    EXPECT_TRUE(near(readImage(bench.renderer, bench.last.outputs.radiance).pixels[32 * 96 + 34],
                     glm::vec3(2, 3, 4)));
}

TEST(BlendedLayers, AStillFrameComesToRestAndSkippingChangesNoBit) {
    RenderSettings settings;
    settings.bounce.sky.settleFrames = 6;
    expectRestAndNoBitSkipped(*scenegen::buildScene("panes", 0), {96, 54}, settings, 30);
}

TEST(BlendedLayers, NoneInSightCostNothing) {
    Bench b(*scenegen::buildScene("panes", 0), {64, 36});
    const auto declared = [&] {
        b.frame();
        return std::ranges::count_if(b.renderer.graph().report(), [](const PassReport& pass) {
            return pass.name.starts_with("blended") || pass.name == "composite.over";
        });
    };
    EXPECT_GT(declared(), 0);
    CameraPose away = cameraOf(b.asset, 0);
    away.position.z += 100;
    away.forward = -away.forward;
    setCamera(b.scene, away, b.size);
    EXPECT_EQ(declared(), 0);
}

}  // namespace
}  // namespace ag::gi
