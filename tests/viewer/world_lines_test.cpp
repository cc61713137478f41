// Area lights and the views of maps as lines.
#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "engine/core/projection.h"
#include "tools/viewer/world_lines.h"

namespace ag::viewer {
namespace {

float longest(const std::vector<Line>& lines) {
    float length = 0;
    for (const Line& l : lines)
        length = std::max(length, glm::distance(l.from, l.to));
    return length;
}

TEST(WorldLines, AnAreaLightIsItsOutlineAndItsNormal) {
    const io::Val light{.position = {1, 2, 3}, .area = 4, .normal = {0, 1, 0}, .flux = {1, 1, 0}};
    io::ValShapeVectors square{};
    const glm::vec2 corners[] = {{1, 1}, {-1, 1}, {-1, -1}, {1, -1}};
    for (size_t i = 0; i < io::kValCorners; ++i)
        square.corners[i] = corners[std::min<size_t>(i, 3)];  // the last one repeats
    const auto lines = linesOf(light, square);
    ASSERT_EQ(lines.size(), 5u);
    for (size_t i = 0; i < 4; ++i) {
        EXPECT_NEAR(lines[i].from.y, 2, 1e-6) << "in its plane";
        EXPECT_NEAR(glm::distance(lines[i].from, lines[i].to), 2, 1e-5);
        EXPECT_EQ(lines[i].to, lines[(i + 1) % 4].from);
    }
    EXPECT_EQ(lines[4].from, light.position);
    EXPECT_NEAR(lines[4].to.y, 2 + std::sqrt(1 / std::numbers::pi_v<float>), 1e-5);
    EXPECT_TRUE(linesOf({.normal = {0, 1, 0}}, square).empty()) << "black ones pad the list";
}

TEST(WorldLines, AViewIsItsFrustum) {
    const glm::mat4 view = glm::lookAt(glm::vec3(0, 5, 0), glm::vec3(0), glm::vec3(0, 0, 1));
    const auto endless = edgesOfView(glm::mat4(reversedInfinitePerspective(1, 1, 0.1f)) * view, 10);
    ASSERT_EQ(endless.size(), 12u);
    for (const Line& l : endless)
        EXPECT_LT(std::max(l.from.y, l.to.y), 5) << "ahead of the eye";
    EXPECT_NEAR(longest(endless), 10, 1e-3) << "it has no end of its own";
    glm::mat4 box(1);  // from depth 1 at y = 5 to depth 0 at y = 3
    box = glm::scale(glm::translate(glm::mat4(1), {0, 0, 0.5f}), {0.5f, 0.5f, 0.25f}) * glm::mat4(1);
    const auto bounded = edgesOfView(box, 100);
    EXPECT_NEAR(longest(bounded), 4, 1e-4);
    EXPECT_NEAR(longest(edgesOfView(box, 1)), 4, 1e-4) << "its ends stay as wide, but come nearer";
}

TEST(WorldLines, MapsOfLampsAreCubesOrSpots) {
    io::LightClusterRow lamp{.center = {1, 1, 1}, .size = 64, .nearDistance = 0.1f, .farDistance = 5};
    EXPECT_NEAR(longest(edgesOfMap(lamp, 10)), 0.4, 1e-5);
    lamp.direction = {0, -1, 0};
    lamp.tanHalf = 1;
    const auto spot = edgesOfMap(lamp, 10);
    EXPECT_NEAR(longest(spot), 10, 1e-4) << "the square at its end";
    for (const Line& l : spot)
        EXPECT_LE(std::max(l.from.y, l.to.y), 0.9f + 1e-5f);
}

TEST(WorldLines, WhatIsBehindTheEyeIsCutOff) {
    const Screen s{{.position = {0, 0, 0}, .forward = {0, 0, -1}, .verticalFov = 1, .near = 0.1f},
                   {200, 100}};
    EXPECT_FALSE(projectedLine(s, {0, 0, 1}, {1, 0, 2}));
    const auto whole = projectedLine(s, {0, 0, -1}, {0, 0, -2});
    ASSERT_TRUE(whole);
    EXPECT_NEAR(glm::distance(whole->from, glm::vec2(100, 50)), 0, 1e-3);
    const auto cut = projectedLine(s, {0, 0, -2}, {0, 1, 2});
    ASSERT_TRUE(cut);
    EXPECT_LT(cut->to.y, 0) << "it leaves by the top";
    const auto same = projectedLine(s, {0, 1, 2}, {0, 0, -2});
    ASSERT_TRUE(same);
    EXPECT_NEAR(glm::distance(same->from, cut->to), 0, 1e-2);
}

}  // namespace
}  // namespace ag::viewer
