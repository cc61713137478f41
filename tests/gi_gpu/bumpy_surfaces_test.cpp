// Normal maps: which way they lean, and what light bumps take and send on.
#include <gtest/gtest.h>

#include "tests/gi_gpu/bench.h"
#include "tests/gi_gpu/bumpy.h"
#include "tools/reference/reference.h"
#include "tools/scenegen/builder.h"
#include "tools/scenegen/scenes.h"

namespace ag::gi {
using namespace render;
using test::withNormalMap, test::withWaves;
namespace {

reference::Reference traced(const RenderScene& scene, glm::uvec2 size, const char* layer, uint32_t samples) {
    JobRunner runner(2);
    return reference::makeReference(reference::RayScene(scene), size,
                                    {.paths = {.bounces = 1}, .samplesPerPixel = samples, .layer = layer},
                                    runner, [](double) {});
}

const glm::vec3 kLeaning = glm::normalize(glm::vec3(0.6f, 0.3f, 0.8f));

// Boards across the picture, 16 pixels a metre: as they are, without tangents, with mirrored texture
// coordinates, with a mirrored node, and seen from behind.
SceneAsset boards() {
    scenegen::SceneBuilder b("boards");
    const uint32_t grey = b.material("grey", glm::vec3(0.5f)), thin = b.material("thin", glm::vec3(0.5f));
    b.materialAt(thin).doubleSided = true;
    uint32_t mirrored = 0;
    for (int i = 0; i < 5; ++i) {
        const glm::vec3 corner(i == 3 ? -0.5f : 2 * float(i) - 4.5f, -0.5f, 0);
        const uint32_t node = i < 4 ? b.quad("board", corner, {1, 0, 0}, {0, 1, 0}, grey)
                                    : b.quad("board", corner, {0, 1, 0}, {1, 0, 0}, thin);
        if (i == 3) mirrored = node;
    }
    b.node(mirrored).local.translation.x = 2;
    b.node(mirrored).local.scale.x = -1;
    b.point("lamp", {0, 0, 5}, glm::vec3(20));
    b.camera("camera", {0, 0, 6}, {0, 0, 0}, glm::degrees(2 * std::atan(1 / 6.0f)));
    SceneAsset asset = withNormalMap(b.finish(), [](glm::uvec2) { return kLeaning; });
    for (size_t v = 0; v < asset.geometry.attributes.size(); ++v) {
        glm::vec4& tangent = asset.geometry.attributes[v].tangent;
        tangent.w = -1;
        if (v / 4 == 1 || v / 4 == 2) tangent = glm::vec4(0);
        if (v / 4 == 2) asset.geometry.attributes[v].uv.x *= -1;
    }
    return asset;
}

TEST(BumpySurfaces, LeanAsTheirTextureLies) {
    Bench b(boards(), {160, 32});
    ImageHandle normal;
    b.output = [&](GraphScope scope, const RenderFrame& f) {
        scope.output(normal = f.gbuffer.surfaces.normal);
    };
    b.frame();
    const Image ours = readImage(b.renderer, normal);
    const Image theirs = traced(b.scene, b.size, "normal", 1).normal;
    // The boards' v grows upward, a texture's downward: its top is below. From behind, u is up and v to the
    // right, so its top is to the left.
    const glm::vec3 k = kLeaning;
    const std::array expected = {glm::vec3(k.x, -k.y, k.z), glm::vec3(k.x, -k.y, k.z),
                                 glm::vec3(-k.x, -k.y, k.z), glm::vec3(-k.x, -k.y, k.z),
                                 glm::vec3(k.y, -k.x, k.z)};
    for (int i = 0; i < 5; ++i) {
        const size_t middle = 16 * 160 + size_t(16 + 32 * i);
        EXPECT_LT(glm::distance(glm::vec3(ours.pixels[middle]), expected[size_t(i)]), 0.01f) << "board " << i;
        EXPECT_LT(glm::distance(glm::vec3(theirs.pixels[middle]), expected[size_t(i)]), 0.01f)
            << "board " << i << " of the reference";
    }
}

double meanOverTruth(Bench& b) {
    const Image truth = traced(b.scene, b.size, "bounce1", 256).bounces[1];
    return meanOf(renderLayer(b.renderer, b.scene, b.size, b.settings, Layer::kBounce1, 16)) / meanOf(truth);
}

// Waves receive less light than the flat wall that they are on, and send less on.
TEST(BumpySurfaces, SendOnWhatTheirBumpsReceive) {
    Bench b(withWaves(*scenegen::buildScene("cornell", 0)), {96, 54});
    const double ratio = meanOverTruth(b);
    std::printf("waves: mean over path tracing's %.4f\n", ratio);
    EXPECT_NEAR(ratio, 1, 0.02);  // 1.05 as if they were flat
}

// Of a floor that the sun grazes and a wall beside it that it does not meet.
TEST(BumpySurfaces, ThatTurnFromASlantingLightTakeNothingFromTheOthers) {
    scenegen::SceneBuilder s("slanting");
    const uint32_t grey = s.material("grey", glm::vec3(0.8f));
    s.quad("floor", {-4, 0, 4}, {8, 0, 0}, {0, 0, -8}, grey);
    s.quad("wall", {-4, 0, -4}, {8, 0, 0}, {0, 6, 0}, grey);
    s.sun("sun", {0.9f, -0.25f, 0.02f}, glm::vec3(10));
    s.camera("camera", {0, 3, 6}, {0, 2.5f, -4}, 50);
    Bench b(withWaves(s.finish(), 0.8f), {96, 54});
    const double ratio = meanOverTruth(b);
    std::printf("waves under a slanting sun: mean over path tracing's %.4f\n", ratio);
    EXPECT_NEAR(ratio, 1, 0.08);  // 0.72 by their mean normal's cosine
}

}  // namespace
}  // namespace ag::gi
