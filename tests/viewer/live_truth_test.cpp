#include "tools/viewer/live_truth.h"

#include <gtest/gtest.h>

#include <chrono>

#include "engine/scene/static_scene.h"
#include "tools/reference/reference.h"
#include "tools/scenegen/scenes.h"

namespace ag::viewer {
namespace {

constexpr glm::uvec2 kSize(32, 18);

struct Box {
    SceneAsset asset = *scenegen::buildScene("cornell", 0);
    RenderScene scene = staticScene(asset, cameraOf(asset, 0).position);

    Box() { look({0, 0, 0}); }
    void look(glm::dvec3 aside) {
        CameraPose pose = cameraOf(asset, 0);
        pose.position += aside;
        setCamera(scene, pose, kSize);
    }
};

// The first picture with so many paths a pixel; null after a minute.
std::shared_ptr<const TruthPicture> await(const LiveTruth& truth, uint32_t samples) {
    for (int i = 0; i < 6000; ++i) {
        auto picture = truth.newest();
        if (picture && picture->samples >= samples) return picture;
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return nullptr;
}

reference::Reference referenceOf(const RenderScene& scene) {
    const reference::RayScene rays(scene);
    JobRunner runner;
    return reference::makeReference(
        rays, kSize,
        {.paths = {.bounces = 16, .glossy = true}, .samplesPerPixel = 512, .seed = 7, .layer = "radiance"},
        runner, [](double) {});
}

TEST(LiveTruth, ConvergesToTheReference) {
    const Box box;
    LiveTruth truth(1, 256);
    truth.follow(box.scene, kSize);
    const auto picture = await(truth, 256);
    ASSERT_TRUE(picture);
    EXPECT_EQ(picture->subject, truth.subject());
    const auto off = compareWithTruth(*picture, referenceOf(box.scene).radiance);
    ASSERT_TRUE(off);
    EXPECT_NEAR(off->meanRatio, 1, 0.02);
    EXPECT_LT(off->relativeRmse, 3 * picture->noise);
    EXPECT_LT(picture->noise, 0.2);
}

TEST(LiveTruth, BeginsAnewWhenAnythingSeenChanges) {
    Box box;
    LiveTruth truth(1, 8);
    truth.follow(box.scene, kSize);
    const auto before = await(truth, 8);
    ASSERT_TRUE(before);
    truth.follow(box.scene, kSize);
    EXPECT_EQ(truth.newest(), before) << "nothing changed";

    box.look({0.2, 0, 0});
    truth.follow(box.scene, kSize);
    EXPECT_EQ(truth.newest(), nullptr) << "that of the old place is no truth of the new one";
    const auto moved = await(truth, 8);
    ASSERT_TRUE(moved);
    EXPECT_GT(compareWithTruth(*moved, before->mean)->relativeRmse, 0.1);

    for (RenderLight& light : box.scene.lights)
        light.intensity *= 2.0f;
    ++box.scene.lightsVersion;
    truth.follow(box.scene, kSize);
    const auto brighter = await(truth, 8);
    ASSERT_TRUE(brighter);
    EXPECT_NEAR(compareWithTruth(*moved, brighter->mean)->meanRatio, 2, 0.3);
}

TEST(LiveTruth, EndsInTheMiddleOfItsWork) {
    const Box box;
    LiveTruth truth(1);
    truth.follow(box.scene, {640, 360});
}

TEST(LiveTruth, RefusesPicturesOfOtherSizes) {
    TruthPicture truth;
    truth.halves[0] = truth.halves[1] = Image(4, 4);
    EXPECT_FALSE(compareWithTruth(truth, Image(5, 4)));
}

}  // namespace
}  // namespace ag::viewer
