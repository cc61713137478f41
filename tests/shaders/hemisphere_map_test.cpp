// Hemispheres on the unit square: there and back.
#include "common/hemisphere_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace ag {
namespace {

using glm::vec2;
using glm::vec3;

TEST(HemisphereMap, OctahedralRoundTrip) {
    std::mt19937 random(5);
    std::normal_distribution<float> g;
    for (int i = 0; i < 10000; ++i) {
        vec3 d(g(random), g(random), std::abs(g(random)));
        const vec2 uv = io::hemisphereEncode(d * 3.0f);
        ASSERT_GE(std::min(uv.x, uv.y), 0);
        ASSERT_LE(std::max(uv.x, uv.y), 1);
        EXPECT_LT(glm::length(io::hemisphereDecode(uv) - glm::normalize(d)), 1e-5f);
    }
}

TEST(HemisphereMap, ParaboloidRoundTrip) {
    std::mt19937 random(6);
    std::normal_distribution<float> g;
    for (int i = 0; i < 10000; ++i) {
        const vec3 d(g(random), g(random), std::abs(g(random)));
        const vec2 uv = io::paraboloidEncode(d * 3.0f);
        ASSERT_LE(glm::length(uv - 0.5f), 0.5001f);
        EXPECT_LT(glm::length(glm::normalize(io::paraboloidDirection(uv)) - glm::normalize(d)), 1e-5f);
    }
}

using Encode = vec2 (*)(vec3);
using Gradients = void (*)(vec3, vec3&, vec3&);

// Largest difference of the gradients from those by central differences.
float gradientError(Encode encode, Gradients gradients) {
    std::mt19937 random(7);
    std::normal_distribution<float> g;
    float most = 0;
    for (int i = 0; i < 1000; ++i) {
        const vec3 d = glm::normalize(vec3(g(random), g(random), std::abs(g(random)) + 0.1f)) * 2.0f;
        if (std::min(std::abs(d.x), std::abs(d.y)) < 0.05f) continue;  // the octahedron's edges
        vec3 u, v;
        gradients(d, u, v);
        for (int axis = 0; axis < 3; ++axis) {
            constexpr float kStep = 0.01f;
            vec3 step(0);
            step[axis] = kStep;
            const vec2 slope = (encode(d + step) - encode(d - step)) / (2 * kStep);
            most = std::max({most, std::abs(slope.x - u[axis]), std::abs(slope.y - v[axis])});
        }
    }
    return most;
}

TEST(HemisphereMap, GradientsAreThoseOfTheMaps) {
    EXPECT_LT(gradientError(io::hemisphereEncode, io::hemisphereGradients), 1e-3f);
    EXPECT_LT(gradientError(io::paraboloidEncode, io::paraboloidGradients), 1e-3f);
}

TEST(HemisphereMap, OctahedralTexelsSeeSimilarSolidAngles) {
    constexpr int kSize = 64;
    double least = 1e9, most = 0, sum = 0;
    for (int y = 0; y < kSize; ++y)
        for (int x = 0; x < kSize; ++x) {
            const auto at = [&](int dx, int dy) {
                return glm::dvec3(io::hemisphereDecode(vec2(float(x + dx), float(y + dy)) / float(kSize)));
            };
            const auto triangle = [](glm::dvec3 p, glm::dvec3 q, glm::dvec3 r) {
                return 0.5 * glm::length(glm::cross(q - p, r - p));
            };
            const double angle =
                triangle(at(0, 0), at(1, 0), at(0, 1)) + triangle(at(1, 1), at(1, 0), at(0, 1));
            least = std::min(least, angle), most = std::max(most, angle), sum += angle;
        }
    const double mean = sum / (kSize * kSize);
    constexpr double kPi = std::numbers::pi;
    EXPECT_NEAR(sum, 2 * kPi, 0.02);
    // Density h / r³ on a face at height h = 1 / sqrt(3): r = 1 in its corners, h in its middle.
    EXPECT_NEAR(least / mean, 1 / std::sqrt(3.0) / (kPi / std::sqrt(3.0)), 0.03);
    EXPECT_NEAR(most / mean, 3 / (kPi / std::sqrt(3.0)), 0.03);
}

}  // namespace
}  // namespace ag
