// The scenes whose light comes in by openings: what falls through is what closed forms say, and nothing else.
#include "tools/scenegen/openings.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/scene/static_scene.h"
#include "tools/reference/reference.h"

namespace ag::reference {
namespace {

struct Lit {
    double power = 0;  // W
    glm::dvec2 least{1e30}, most{-1e30};
    double area = 0;  // m²
};

// Of a horizontal rectangle from `least` to `most` (x, z) at height y, by the middles of n x n cells.
Lit sunOn(const RayScene& rays, glm::dvec2 least, glm::dvec2 most, double y, uint32_t n) {
    const RenderLight& sun = rays.lights()[0].light;
    const glm::dvec2 cell = (most - least) / double(n);
    Lit lit;
    for (uint32_t i = 0; i < n * n; ++i) {
        const glm::dvec2 at = least + cell * (glm::dvec2(i % n, i / n) + 0.5);
        const glm::vec3 from(float(at.x), float(y) + rays.offset(), float(at.y));
        if (!rays.visible(from, -sun.direction, 1e30f)) continue;
        lit.area += cell.x * cell.y;
        lit.power += double(sun.intensity.x * -sun.direction.y) * cell.x * cell.y;
        lit.least = glm::min(lit.least, at), lit.most = glm::max(lit.most, at);
    }
    return lit;
}

TEST(Openings, TheWindowsPatchHasItsClosedForm) {
    const scenegen::FloorPatch patch = scenegen::windowPatch();
    for (const uint32_t param : {0u, 1u}) {
        const SceneAsset asset = scenegen::window(param);
        const RenderScene scene = staticScene(asset);
        const RayScene rays(scene);
        const Lit lit = sunOn(rays, {-2.5, -2}, {2.5, 2}, 0, 1000);
        EXPECT_NEAR(lit.power / scenegen::windowPatchPower(), 1, 0.005) << "furniture stands beside the beam";
        for (int axis = 0; axis < 2; ++axis) {
            EXPECT_NEAR(lit.least[axis], patch.least[axis], 0.006);
            EXPECT_NEAR(lit.most[axis], patch.most[axis], 0.006);
        }
    }
}

// The opening's sides take the rest of the beam, and the room nothing of its own.
TEST(Openings, TheWindowsSidesTakeTheRest) {
    const SceneAsset asset = scenegen::window(1);
    const RenderScene scene = staticScene(asset);
    const RayScene rays(scene);
    const glm::vec3 d = rays.lights()[0].light.direction;
    const Lit sill = sunOn(rays, {2.5, -0.6}, {2.7, 0.3}, 1, 400);
    const double wide = 0.9, high = 1.1, deep = 0.2, e = 12;
    const double slope = std::abs(double(d.y / d.x)), skew = std::abs(double(d.z / d.x));
    // Of the beam's cross-section along x, what has sunk past the sill before the inner face, less the corner
    // that the opening's side has taken before: half of where both have moved.
    const double sunk = e * std::abs(double(d.x)) * deep * slope * (wide - deep * skew / 2);
    EXPECT_NEAR(sill.power / sunk, 1, 0.01);
    EXPECT_LT(scenegen::windowPatchPower() + sill.power, e * std::abs(double(d.x)) * wide * high);
}

TEST(Openings, NothingComesIntoTheShell) {
    const SceneAsset asset = scenegen::shell(1);
    RenderScene scene = staticScene(asset);
    const glm::uvec2 size(64, 36);
    JobRunner runner(2);
    for (const glm::dvec3 eye :
         {glm::dvec3(2.5, 1.5, 2.5), glm::dvec3(-2.8, 0.2, 2.8), glm::dvec3(0, 4.5, 0)}) {
        const glm::vec3 forward = glm::normalize(glm::vec3(glm::dvec3(-0.2, 2.4, -0.1) - eye));
        setCamera(scene, {.position = eye, .forward = forward}, size);
        const RayScene rays(scene);
        const Reference r = makeReference(rays, size, {.paths = {.bounces = 4}, .samplesPerPixel = 64},
                                          runner, [](double) {});
        double sum = 0;
        for (const glm::vec3& p : r.irradiance.pixels)
            sum += double(p.x + p.y + p.z);
        EXPECT_EQ(sum, 0);
    }
    const RayScene rays(scene);
    const Lit roof = sunOn(rays, {-0.5, -0.5}, {0.5, 0.5}, 5.5, 50);
    EXPECT_NEAR(roof.area, 1, 0.01) << "the sun shines on the dome";
    Surface inner, outer;
    ASSERT_TRUE(rays.intersect({0.1f, 3.5f, 0.1f}, {0, 1, 0}, inner));
    ASSERT_TRUE(rays.intersect({0.1f, 9, 0.1f}, {0, -1, 0}, outer));
    EXPECT_LT(outer.position.y - inner.position.y, 0.06f) << "thin";
    EXPECT_GT(outer.position.y - inner.position.y, 0.03f);
}

TEST(Openings, OnlyTheLedgesAreLit) {
    const SceneAsset asset = scenegen::ledges(0);
    const RenderScene scene = staticScene(asset);
    const RayScene rays(scene);
    const glm::vec3 d = rays.lights()[0].light.direction;
    EXPECT_GT(d.z, 0) << "the wall's face, along +z, is turned away";
    const float heights[] = {1.2f, 3.6f, 2.4f, 4.8f};
    for (int i = 0; i < 12; ++i) {
        const double x = (i - 5.5) * 1.25;
        const Lit sill = sunOn(rays, {x - 0.5, 0}, {x + 0.5, 0.08}, double(heights[i % 4]), 100);
        EXPECT_GT(sill.area, 0.02) << "sill " << i;
        EXPECT_LT(sill.most.y - sill.least.y, 0.08) << "sill " << i;
    }
}

TEST(Openings, TheSunMeetsTheNaveAndNotAllOfIt) {
    const SceneAsset asset = scenegen::nave(0);
    const RenderScene scene = staticScene(asset);
    const RayScene rays(scene);
    const Lit nave = sunOn(rays, {-3, -9}, {3, 9}, 0, 300), right = sunOn(rays, {3.6, -9}, {6, 9}, 0, 300);
    EXPECT_GT(nave.area, 0.5);
    EXPECT_LT(nave.area, 10);
    EXPECT_EQ(right.area, 0) << "the aisle below the windows sees no sun";
}

}  // namespace
}  // namespace ag::reference
