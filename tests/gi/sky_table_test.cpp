// The sky as rays are drawn by it.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/renderer/sky_gpu.h"
#include "gi/sky.h"

namespace ag::render {
namespace {

// Irradiance on a plane that looks along `n`.
glm::dvec3 irradianceOf(const gi::SkyTable& table, glm::vec3 n) {
    glm::dvec3 sum(0);
    for (uint32_t cell = 0; cell < io::kSkyCells; ++cell)
        for (uint32_t t = 0; t < io::kSkyCellTexels; ++t) {
            const glm::vec3 d = io::skyDirectionAt(io::skyPlaceOf(cell, t, glm::vec2(0.5f)));
            const double cosine = std::max(double(glm::dot(n, d)), 0.0);
            sum += glm::dvec3(table.texels[cell * io::kSkyCellTexels + t].radiance) * cosine;
        }
    return sum * (4 * std::numbers::pi / (io::kSkySide * io::kSkySide));
}

TEST(SkyTable, HoldsTheLightOfThePicture) {
    const gi::SkyTable even = skyTable(constantSky({1, 2, 3}), 0.5f);
    for (const glm::vec3 n : {glm::vec3(0, 1, 0), glm::vec3(0.6f, -0.8f, 0)})
        EXPECT_NEAR(irradianceOf(even, n).z, 6 * std::numbers::pi, 0.02);

    // A sun's disc of a few texels of a large picture, in a sky that is dark else.
    Sky sun{Image(2048, 1024)};
    double power = 0;
    for (int y = 300; y < 304; ++y)
        for (int x = 700; x < 704; ++x) {
            sun.radiance.at(x, y) = glm::vec3(1e5f);
            power += 1e5 * double(skyTexelAngle({2048, 1024}, y));
        }
    const gi::SkyTable table = skyTable(sun, 1);
    const glm::vec3 toward = skyDirection(glm::vec2(702, 302) / glm::vec2(2048, 1024));
    EXPECT_NEAR(irradianceOf(table, toward).x / power, 1, 0.002);
    EXPECT_NEAR(double(table.upTo.back()) / power, 1, 1e-4);
}

TEST(SkyTable, ChancesAreSumsUpToOne) {
    const gi::SkyTable table = skyTable(analyticSky(glm::normalize(glm::vec3(1, -1, 0.5f)), 3), 1);
    float before = 0;
    for (uint32_t cell = 0; cell < io::kSkyCells; ++cell) {
        EXPECT_GE(table.upTo[cell], before);
        before = table.upTo[cell];
        float inCell = 0;
        for (uint32_t t = 0; t < io::kSkyCellTexels; ++t) {
            const float upTo = table.texels[cell * io::kSkyCellTexels + t].upTo;
            EXPECT_GT(upTo, inCell) << "each can be drawn";
            inCell = upTo;
        }
        EXPECT_EQ(inCell, 1);
    }
}

}  // namespace
}  // namespace ag::render
