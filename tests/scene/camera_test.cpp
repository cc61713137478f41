// Cameras as glTF has them: they look along their node's -Z, and the picture's top is its +Y.
#include <gtest/gtest.h>

#include <glm/gtc/quaternion.hpp>

#include "engine/scene/static_scene.h"

namespace ag {
namespace {

// One camera node at the origin.
RenderScene seenBy(glm::quat rotation) {
    static SceneAsset asset;
    asset = {};
    asset.cameras.push_back({"camera", 1.0f, 0.05f});
    asset.nodes.push_back({.name = "camera", .camera = 0});
    asset.nodes[0].local.rotation = rotation;
    RenderScene scene = staticScene(asset);
    setCamera(scene, cameraOf(asset, 0), {100, 100});
    return scene;
}

// Where on the picture a direction lies: x right, y up, -1 to 1 at the edges.
glm::vec2 onPicture(const RenderScene& scene, glm::vec3 direction) {
    const glm::vec4 clip = scene.camera.clipFromWorld * glm::vec4(direction * 10.0f, 1);
    return {clip.x / clip.w, -clip.y / clip.w};
}

TEST(Camera, TakesItsNodesWholeRotation) {
    for (const float degrees : {0.0f, 30.0f, -75.0f, 180.0f}) {
        const glm::quat roll = glm::angleAxis(glm::radians(degrees), glm::vec3(0, 0, 1));
        for (const glm::quat& turn :
             {glm::quat(1, 0, 0, 0), glm::angleAxis(0.7f, glm::normalize(glm::vec3(1, 2, 0.5f)))}) {
            const glm::quat rotation = turn * roll;
            const RenderScene scene = seenBy(rotation);
            EXPECT_LT(glm::distance(onPicture(scene, rotation * glm::vec3(0, 0, -1)), {0, 0}), 1e-5f);
            const glm::vec2 right = onPicture(scene, rotation * glm::vec3(0.2f, 0, -1)),
                            top = onPicture(scene, rotation * glm::vec3(0, 0.2f, -1));
            EXPECT_GT(right.x, 0.3f) << degrees;
            EXPECT_NEAR(right.y, 0, 1e-5f) << degrees;
            EXPECT_GT(top.y, 0.3f) << degrees;
            EXPECT_NEAR(top.x, 0, 1e-5f) << degrees;
        }
    }
}

TEST(Camera, LooksStraightDownAndUpTheRightWayRound) {
    for (const float pitch : {-90.0f, 90.0f}) {
        const glm::quat rotation = glm::angleAxis(glm::radians(pitch), glm::vec3(1, 0, 0));
        const RenderScene scene = seenBy(rotation);
        EXPECT_GT(onPicture(scene, rotation * glm::vec3(0.2f, 0, -1)).x, 0.3f);
        EXPECT_GT(onPicture(scene, rotation * glm::vec3(0, 0.2f, -1)).y, 0.3f);
        // The same without a word on which way is up.
        RenderScene upright = scene;
        setCamera(upright, {.forward = rotation * glm::vec3(0, 0, -1), .verticalFov = 1.0f}, {100, 100});
        EXPECT_GT(onPicture(upright, rotation * glm::vec3(0.2f, 0, -1)).x, 0.3f);
        EXPECT_GT(onPicture(upright, rotation * glm::vec3(0, 0.2f, -1)).y, 0.3f);
    }
}

TEST(Camera, PoseOfAScenesCameraSetsItAgain) {
    const RenderScene scene = seenBy(glm::angleAxis(0.7f, glm::normalize(glm::vec3(1, 2, 0.5f))));
    RenderScene again = scene;
    again.camera = {};
    setCamera(again, poseOf(scene), {100, 100});
    for (int c = 0; c < 4; ++c)
        EXPECT_LT(glm::distance(again.camera.clipFromWorld[c], scene.camera.clipFromWorld[c]), 1e-5f);
}

}  // namespace
}  // namespace ag
