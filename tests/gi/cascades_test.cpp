// Cascades keep their texels while things move at the scene's edge, and are the same in a scene of any size.
#include "engine/renderer/cascades.h"

#include <gtest/gtest.h>

#include "engine/core/projection.h"
#include "engine/renderer/render_units.h"

namespace ag::gi {
using namespace render;
namespace {

constexpr glm::vec3 kSun(0.267261242f, -0.801783726f, 0.534522484f);
constexpr Bounds kHall{{-6, 0, -2}, {6, 3, 2}};
constexpr float kWhole = 40;  // m, past the scene's end

Cascade cascade(const Bounds& casters, float scale, float extent, float end = 4) {
    RenderCamera camera;
    camera.position = scale * glm::vec3(3, 1.5f, 0.5f);
    camera.forward = glm::normalize(glm::vec3(-1, -0.1f, 0.2f));
    const Bounds scaled{casters.min * scale, casters.max * scale};
    const FrustumSlice slice{.camera = camera, .aspect = 1.6f, .near = 0.1f * scale, .far = end * scale};
    return fitCascade(slice, kSun, scaled, extent * scale, 1024);
}

TEST(Cascades, FollowTheScenesScale) {
    const float extent = steadyExtent(kHall, 0);
    const Cascade one = cascade(kHall, 1, extent);
    for (const float scale : {0.013f, 0.1f, 3.0f, 10.0f, 700.0f}) {
        const Cascade other = cascade(kHall, scale, extent);
        EXPECT_NEAR(other.size.x / scale, one.size.x, 1e-4f);
        EXPECT_NEAR(other.size.y / scale, one.size.y, 1e-4f);
        const glm::vec4 corner(2, 1, -1, 1), seen = one.clipFromWorld * corner;
        const glm::vec4 scaled = other.clipFromWorld * glm::vec4(glm::vec3(corner) * scale, 1);
        EXPECT_LT(glm::length(scaled - seen), 1.0f / 1024) << "half a texel, scaled by " << scale;
    }
}

TEST(Cascades, KeepTheirTexelsWhileSomethingMovesAtTheEdge) {
    float extent = steadyExtent(kHall, 0);
    glm::vec2 size = cascade(kHall, 1, extent, kWhole).size;
    int changes = 0;
    for (int i = 0; i < 100; ++i) {
        Bounds moved = kHall;
        moved.max.x += 0.001f * float(i);
        extent = steadyExtent(moved, extent);
        const glm::vec2 now = cascade(moved, 1, extent, kWhole).size;
        changes += now != size;
        size = now;
    }
    EXPECT_LE(changes, 1) << "of a hundred places";
}

TEST(SteadyExtent, StaysUntilTheSceneOutgrowsItOrLeavesMostOfIt) {
    const auto cube = [](float side) { return Bounds{glm::vec3(0), glm::vec3(side)}; };
    const float chosen = steadyExtent(cube(1), 0);
    EXPECT_GT(chosen, std::sqrt(3.0f));
    for (const float side : {0.6f, 0.9f, 1.2f})
        EXPECT_EQ(steadyExtent(cube(side), chosen), chosen);
    EXPECT_GT(steadyExtent(cube(2), chosen), chosen);
    EXPECT_LT(steadyExtent(cube(0.2f), chosen), chosen);
    EXPECT_GT(steadyExtent(cube(0), 0), 0) << "a point";
    EXPECT_EQ(steadyExtent({}, chosen), chosen) << "nothing there yet";
}

Bounds cubeAt(float side, float x) {
    const glm::vec3 corner(x, 0, 0);
    return {corner, corner + side};
}

TEST(RayOffset, IsShortAndMoreThanCoordinatesAreRoundedBy) {
    const auto offset = [](float side, float x) {
        return rayOffset(cubeAt(side, x), steadyExtent(cubeAt(side, x), 0));
    };
    EXPECT_NEAR(offset(2, 0) / offset(1, 0), 2, 1e-3) << "of the extent";
    EXPECT_LT(offset(60, 0), 6e-4f) << "behind a thin sheet in a large scene nothing is met";
    EXPECT_GT(offset(4, 2000), std::nextafter(2004.0f, 3000.0f) - 2004.0f) << "what a float can tell there";
    EXPECT_EQ(offset(4, 2000), offset(4, 2000.5f)) << "stays while things move";
}

}  // namespace
}  // namespace ag::gi
