#include "engine/app/free_camera.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ag {
namespace {

Bounds box() {
    Bounds b;
    b.add({-6, 0, -6});
    b.add({6, 6, 6});
    return b;
}

FreeCamera looking(glm::vec3 forward) {
    CameraPose pose;
    pose.position = {1, 2, 3};
    pose.forward = glm::normalize(forward);
    pose.verticalFov = 0.9f;
    pose.near = 0.02f;
    return freeCameraAt(pose, box());
}

TEST(FreeCamera, StartsAsThePoseLooks) {
    for (const glm::vec3 forward : {glm::vec3(0, 0, -1), glm::vec3(1, 0, 0), glm::vec3(-0.3f, 0.5f, 0.8f),
                                    glm::vec3(0.2f, -0.9f, -0.1f)}) {
        const CameraPose pose = poseOf(looking(forward));
        EXPECT_NEAR(glm::distance(pose.forward, glm::normalize(forward)), 0, 1e-5f);
        EXPECT_EQ(pose.position, glm::dvec3(1, 2, 3));
        EXPECT_EQ(pose.verticalFov, 0.9f);
        EXPECT_EQ(pose.near, 0.02f);
    }
}

TEST(FreeCamera, KeepsThePosesRoll) {
    for (const float roll : {-2.5f, -0.4f, 0.0f, 0.7f}) {
        CameraPose pose;
        pose.forward = glm::normalize(glm::vec3(0.3f, -0.2f, -0.9f));
        const glm::vec3 right = glm::normalize(glm::cross(pose.forward, glm::vec3(0, 1, 0)));
        pose.up = std::cos(roll) * glm::cross(right, pose.forward) + std::sin(roll) * right;
        FreeCamera c = freeCameraAt(pose, box());
        EXPECT_NEAR(glm::distance(poseOf(c).up, pose.up), 0, 1e-5f) << roll;
        moveFreely(c, {.forward = 1, .look = {30, 10}}, 0.1f);
        EXPECT_NEAR(c.roll, roll, 1e-5f);
    }
}

TEST(FreeCamera, FliesAlongItsViewAtItsSpeed) {
    FreeCamera c = looking({1, 1, 0});
    moveFreely(c, {.forward = 1}, 0.5f);
    const glm::dvec3 moved = c.position - glm::dvec3(1, 2, 3);
    EXPECT_NEAR(glm::length(moved), double(c.speed) * 0.5, 1e-5);
    EXPECT_NEAR(moved.x, moved.y, 1e-5);
    moveFreely(c, {.right = 1}, 0.5f);
    EXPECT_NEAR(c.position.z - 3, double(c.speed) * 0.5, 1e-5) << "to the right of +x is +z";
    const double height = c.position.y;
    moveFreely(c, {.buttons = kButtonJump}, 0.5f);
    EXPECT_NEAR(c.position.y - height, double(c.speed) * 0.5, 1e-5);
}

TEST(FreeCamera, TurnsToTheRightAndUpAndNotOverTheTop) {
    FreeCamera c = looking({0, 0, -1});
    moveFreely(c, {.look = {40, 0}}, 0.1f);
    EXPECT_GT(poseOf(c).forward.x, 0.05f);
    moveFreely(c, {.look = {0, -40}}, 0.1f);
    EXPECT_GT(poseOf(c).forward.y, 0.05f);
    moveFreely(c, {.look = {0, -1e6f}}, 0.1f);
    EXPECT_GT(poseOf(c).forward.y, 0.99f);
    const glm::vec3 heading = -poseOf(c).up;  // what was ahead, for one who looks straight up
    EXPECT_GT(heading.x, 0.05f);
    EXPECT_LT(heading.z, -0.9f);
}

TEST(FreeCamera, LooksStraightDownAsThePoseDoes) {
    CameraPose pose;
    pose.forward = {0, -1, 0};
    for (const glm::vec3 up : {glm::vec3(0, 0, -1), glm::vec3(1, 0, 0), glm::vec3(-0.6f, 0, 0.8f)}) {
        pose.up = up;
        FreeCamera c = freeCameraAt(pose, box());
        moveFreely(c, {}, 0.1f);
        EXPECT_NEAR(glm::distance(poseOf(c).forward, pose.forward), 0, 1e-6f);
        EXPECT_NEAR(glm::distance(poseOf(c).up, up), 0, 1e-6f);
    }
}

TEST(FreeCamera, CirclesAboutWhatIsAhead) {
    FreeCamera c = looking({0, 0, -1});
    c.orbits = true;
    const auto focusOf = [&] { return c.position + glm::dvec3(poseOf(c).forward) * double(c.focusDistance); };
    const glm::dvec3 focus = focusOf();
    for (int i = 0; i < 20; ++i)
        moveFreely(c, {.look = {30, -5}}, 0.02f);
    EXPECT_NEAR(glm::distance(focusOf(), focus), 0, 1e-4);
    EXPECT_GT(glm::distance(c.position, glm::dvec3(1, 2, 3)), 1);
    const float before = c.focusDistance;
    moveFreely(c, {.forward = 1}, 0.5f);
    EXPECT_LT(c.focusDistance, before);
    EXPECT_NEAR(glm::distance(focusOf(), focus), 0, 1e-4) << "nearer to the same point";
    moveFreely(c, {.forward = 1}, 1e3f);
    EXPECT_GE(c.focusDistance, 0);
    EXPECT_TRUE(std::isfinite(c.position.x));
}

}  // namespace
}  // namespace ag
