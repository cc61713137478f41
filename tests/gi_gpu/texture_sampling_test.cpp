// How textures are averaged over the camera's pixels, against path tracing that averages them over each
// pixel.
#include "engine/core/image_difference.h"
#include "tests/gi_gpu/bench.h"
#include "tools/reference/reference.h"
#include "tools/scenegen/builder.h"

namespace ag::gi {
using namespace render;
namespace {

// A floor, the first material's, before a wall; both 16 m wide.
SceneAsset floorAndWall() {
    scenegen::SceneBuilder s("floor");
    s.quad("floor", {-8, 0, -12}, {0, 0, 12}, {16, 0, 0}, s.material("floor", glm::vec3(0.9f)));
    s.quad("wall", {-8, -1, -12}, {16, 0, 0}, {0, 8, 0}, s.material("wall", glm::vec3(0.2f)));
    s.point("lamp", {0, 4, -4}, glm::vec3(20));
    s.camera("camera", {0, 1, 3}, {0, 0.5f, -6}, 50);
    return s.finish();
}

// The texture so many times from side to side.
auto repeated(float times) {
    return [times](glm::vec3 p) { return glm::vec2(p.x + 8, p.z + 12) * (times / 16); };
}

Image traced(const Bench& b, const char* layer) {
    const reference::RayScene rays(b.scene);
    JobRunner runner(2);
    return *reference::layerOf(
        reference::makeReference(rays, b.size,
                                 {.paths = {.bounces = 0}, .samplesPerPixel = 1, .layer = layer}, runner,
                                 [](double) {}),
        layer);
}

Image rendered(Bench& b, Layer layer, uint32_t frames = 1) {
    return renderLayer(b.renderer, b.scene, b.size, settingsOf(layer, b.settings), layer, frames);
}

// A quarter of each 4 x 4 texels covers; a pixel sees up to hundreds. Their mean alpha passes no cut-off.
TEST(TextureSampling, MaskedSurfacesCoverWhatTheirTexelsDo) {
    SceneAsset asset = floorAndWall();
    cutOut(
        asset, 0, [](uint32_t x, uint32_t y) { return x % 4 < 2 && y % 4 < 2; }, repeated(8));
    Bench b(std::move(asset), {160, 96});
    const Image depth = rendered(b, Layer::kDepth), truth = traced(b, "depth");
    size_t covered = 0, coveredTruth = 0, others = 0;
    for (size_t i = 0; i < truth.pixels.size(); ++i) {
        const bool floor = depth.pixels[i].x < 14 && depth.pixels[i].x > 0,
                   floorTruth = truth.pixels[i].x < 14 && truth.pixels[i].x > 0;
        covered += floor, coveredTruth += floorTruth, others += floor != floorTruth;
    }
    std::printf("masked: %zu pixels covered, %zu by the reference, %zu are others\n", covered, coveredTruth,
                others);
    EXPECT_GT(coveredTruth, truth.pixels.size() / 20);
    EXPECT_LT(double(others), 0.02 * double(coveredTruth));
}

// Stripes that run away from the camera are as fine along a pixel's row as they are coarse along its column.
TEST(TextureSampling, StripesSeenAtASlantStaySharpWhereNothingMoves) {
    if (test::device().info().mostAnisotropy < 2) GTEST_SKIP() << "the device has no anisotropic filtering";
    SceneAsset asset = floorAndWall();
    const auto stripes = [](uint32_t x, uint32_t) {
        return glm::u8vec4(glm::u8vec3(x % 32 < 16 ? 255 : 60), 255);
    };
    addTexture(asset, 0, stripes, repeated(4));
    Bench b(std::move(asset), {160, 96});
    const Image truth = traced(b, "albedo");
    const auto errorOf = [&](const Image& image) { return compareImages(truth, image)->relativeRmse; };
    const double still = errorOf(rendered(b, Layer::kAlbedo, 2));
    const glm::dvec3 place = cameraOf(b.asset, 0).position;
    CameraPose pose = cameraOf(b.asset, 0);
    const auto arrive = [&] {  // from the side
        pose.position = place + glm::dvec3(0.1, 0, 0);
        setCamera(b.scene, pose, b.size);
        rendered(b, Layer::kAlbedo);
        pose.position = place;
        setCamera(b.scene, pose, b.size);
    };
    arrive();
    const double moving = errorOf(rendered(b, Layer::kAlbedo)), stands = errorOf(rendered(b, Layer::kAlbedo));
    std::printf("stripes: relative RMSE %.4f, while the camera moves %.4f, then %.4f\n", still, moving,
                stands);
    EXPECT_LT(still, 0.2);
    EXPECT_EQ(stands, still);
    if (test::device().info().isCpu) {
        EXPECT_GT(moving, 2 * still);
    } else {
        EXPECT_EQ(moving, still);
    }
}

}  // namespace
}  // namespace ag::gi
