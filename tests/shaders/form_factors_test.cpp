// The shipped form factors against dense quadrature of the emitter.
#include "common/form_factors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <numbers>
#include <random>

#include "common/sampling.h"

namespace ag {
namespace {

using glm::dvec3;
using glm::vec3;

// Irradiance factor of a unit-radiosity emitter patch set, in double precision.
template <class F>
double quadrature(dvec3 x, dvec3 n, dvec3 m, int steps, F&& place, double area) {
    double sum = 0;
    for (int i = 0; i < steps; ++i)
        for (int j = 0; j < steps; ++j) {
            const dvec3 d = place((i + 0.5) / steps, (j + 0.5) / steps) - x;
            const double d2 = glm::dot(d, d);
            sum +=
                std::max(glm::dot(n, d), 0.0) * std::max(-glm::dot(m, d), 0.0) / (std::numbers::pi * d2 * d2);
        }
    return sum * area / (steps * steps);
}

double diskFactor(vec3 x, vec3 n, float radius) {
    const auto place = [&](double u, double v) {
        const double r = radius * std::sqrt(u), phi = 2 * std::numbers::pi * v;
        return dvec3(r * std::cos(phi), 0, r * std::sin(phi));
    };
    return quadrature(x, n, {0, 1, 0}, 256, place, std::numbers::pi * double(radius) * double(radius));
}

vec3 randomUnit(std::mt19937& random) {
    std::normal_distribution<float> g;
    return glm::normalize(vec3(g(random), g(random), g(random)));
}

struct DiskErrors {
    double vectorForm, published;
};

// Relative RMSE of a disk's irradiance over receivers at one distance: all places more than 12 degrees above
// its plane (the rim itself is singular for the quadrature), all orientations that face its centre.
DiskErrors diskErrors(float distance) {
    std::mt19937 random(7);
    double squares = 0, publishedSquares = 0, mean = 0;
    constexpr int kReceivers = 400;
    for (int i = 0; i < kReceivers; ++i) {
        vec3 x = randomUnit(random);
        x = glm::normalize(vec3(x.x, std::abs(x.y) + 0.2f, x.z)) * distance;
        vec3 n = randomUnit(random);
        if (glm::dot(n, x) > 0) n = -n;
        const double truth = diskFactor(x, n, 1);
        const double area = std::numbers::pi;
        squares += std::pow(io::diskVectorFactor(x, n, vec3(0), vec3(0, 1, 0), 1.0f) - truth, 2);
        publishedSquares +=
            std::pow(area * io::diskPublishedTerm(x, n, vec3(0), vec3(0, 1, 0), float(area)) - truth, 2);
        mean += truth;
    }
    mean /= kReceivers;
    return {std::sqrt(squares / kReceivers) / mean, std::sqrt(publishedSquares / kReceivers) / mean};
}

TEST(FormFactors, VectorDiskAgainstQuadrature) {
    const DiskErrors r1 = diskErrors(1), r2 = diskErrors(2), r3 = diskErrors(3);
    std::cout << "vector disk " << r1.vectorForm << ' ' << r2.vectorForm << ' ' << r3.vectorForm
              << ", published " << r1.published << ' ' << r2.published << ' ' << r3.published << '\n';
    RecordProperty("errors", std::to_string(r1.vectorForm) + " " + std::to_string(r2.vectorForm) + " " +
                                 std::to_string(r3.vectorForm));
    EXPECT_LT(r1.vectorForm, 0.06);
    EXPECT_LT(r2.vectorForm, 0.02);
    EXPECT_LT(r3.vectorForm, 0.012);
    EXPECT_GT(r1.published, 5 * r1.vectorForm);
    EXPECT_GT(r2.published, 5 * r2.vectorForm);
    EXPECT_GT(r3.published, 3 * r3.vectorForm);
}

TEST(FormFactors, VectorDiskFarAwayIsAPoint) {
    for (const float distance : {50.0f, 1e3f, 3e4f}) {
        const vec3 x = glm::normalize(vec3(0.6f, 0.7f, 0.2f)) * distance;
        const vec3 n = glm::normalize(-x + vec3(0.1f * distance, 0, 0));
        const float disk = io::diskVectorFactor(x, n, vec3(0), vec3(0, 1, 0), 1.0f);
        const float point = float(std::numbers::pi) * io::vplTerm(x, n, vec3(0), vec3(0, 1, 0));
        EXPECT_NEAR(disk / point, 1, 2e-3) << distance;
    }
}

TEST(FormFactors, VectorDiskIsBoundedAndFiniteEverywhere) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> exponent(-4, 4);
    for (int i = 0; i < 20000; ++i) {
        const float scale = std::pow(10.0f, exponent(random));
        vec3 x = randomUnit(random) * scale;
        if (i % 3 == 0) x.y = 0;             // in the emitter's plane
        if (i % 7 == 0) x = vec3(0);         // at its centre
        if (i % 11 == 0) x = vec3(1, 0, 0);  // on its rim
        const float f = io::diskVectorFactor(x, randomUnit(random), vec3(0), vec3(0, 1, 0), 1.0f);
        ASSERT_TRUE(std::isfinite(f)) << x.x << ' ' << x.y << ' ' << x.z;
        ASSERT_GE(f, 0);
        ASSERT_LE(f, 1.001f);
    }
    EXPECT_EQ(io::diskVectorFactor(vec3(0, 1, 0), vec3(0, -1, 0), vec3(0), vec3(0, 1, 0), 0.0f), 0);
}

TEST(FormFactors, RectangleAgainstQuadrature) {
    std::mt19937 random(11);
    const vec3 u(0.7f, 0, 0), v(0, 0, 0.4f), m(0, 1, 0);
    const auto place = [&](double s, double t) { return dvec3(u) * (2 * s - 1) + dvec3(v) * (2 * t - 1); };
    for (int i = 0; i < 200; ++i) {
        vec3 x = randomUnit(random) * 1.5f;
        x.y = std::abs(x.y) + 0.2f;
        const vec3 n = randomUnit(random);
        const double area = 4 * 0.7 * 0.4;
        const double truth = quadrature(x, n, m, 200, place, area);
        EXPECT_NEAR(io::rectangleTerm(x, n, vec3(0), m, u, v) * area, truth, 2e-4 + 1e-3 * truth);
    }
    EXPECT_EQ(io::rectangleTerm(vec3(0, -1, 0), vec3(0, 1, 0), vec3(0), m, u, v), 0) << "lit from behind";
}

constexpr glm::vec2 kSquare[8] = {{0.2f, 0.2f},   {0.2f, 0.2f},   {-0.2f, 0.2f}, {-0.2f, 0.2f},
                                  {-0.2f, -0.2f}, {-0.2f, -0.2f}, {0.2f, -0.2f}, {0.2f, -0.2f}};

struct PolygonErrors {
    double meanRatio, relativeRmse;
};

// A square of side 0.4 whose radiosity rises by `slope` a metre along x, against quadrature, over receivers
// at one distance with random orientations that face it.
PolygonErrors polygonErrors(float distance, float slope) {
    std::mt19937 random(1);
    glm::vec2 corners[8];
    std::ranges::copy(kSquare, corners);
    const glm::vec4 gradient(slope, 0, 1, 0.4f * 0.4f / 12);
    double got = 0, wanted = 0, squares = 0;
    constexpr int kReceivers = 300, kSteps = 120;
    for (int i = 0; i < kReceivers; ++i) {
        vec3 p = randomUnit(random);
        p = glm::normalize(vec3(p.x, p.y, std::abs(p.z) + 0.1f)) * distance;
        const vec3 n = glm::normalize(randomUnit(random) - p / distance);
        double truth = 0;
        for (int a = 0; a < kSteps; ++a)
            for (int b = 0; b < kSteps; ++b) {
                const dvec3 y((a + 0.5) / kSteps * 0.4 - 0.2, (b + 0.5) / kSteps * 0.4 - 0.2, 0);
                const dvec3 d = y - dvec3(p);
                const double d2 = glm::dot(d, d);
                truth += std::max(glm::dot(dvec3(n), d), 0.0) * double(p.z) / (std::numbers::pi * d2 * d2) *
                         (1 + double(slope) * y.x) * 0.16 / (kSteps * kSteps);
            }
        const double f = double(io::polygonVectorFactor(p, n, corners, gradient, 0));
        got += f, wanted += truth, squares += (f - truth) * (f - truth);
    }
    return {got / wanted, std::sqrt(squares / kReceivers) / (wanted / kReceivers)};
}

TEST(FormFactors, PolygonAgainstQuadrature) {
    for (const float slope : {0.0f, 3.0f}) {
        const PolygonErrors near = polygonErrors(0.3f, slope), mid = polygonErrors(0.6f, slope),
                            far = polygonErrors(1.2f, slope);
        std::cout << "polygon, slope " << slope << ": " << near.relativeRmse << ' ' << mid.relativeRmse << ' '
                  << far.relativeRmse << '\n';
        EXPECT_NEAR(near.meanRatio, 1, 0.02);
        EXPECT_NEAR(mid.meanRatio, 1, 0.005);
        EXPECT_NEAR(far.meanRatio, 1, 0.005);
        EXPECT_LT(near.relativeRmse, 0.08);
        EXPECT_LT(mid.relativeRmse, 0.02);
        EXPECT_LT(far.relativeRmse, 0.01);
    }
}

TEST(FormFactors, PolygonIsBoundedEverywhereAndDarkOnItsPlane) {
    std::mt19937 random(9);
    std::uniform_real_distribution<float> exponent(-4, 4);
    glm::vec2 corners[8];
    std::ranges::copy(kSquare, corners);
    for (int i = 0; i < 20000; ++i) {
        vec3 p = randomUnit(random) * std::pow(10.0f, exponent(random));
        if (i % 3 == 0) p.z *= 1e-5f;
        if (i % 7 == 0) p = vec3(0);
        if (i % 11 == 0) p = vec3(0.2f, 0, 0);
        const float f = io::polygonVectorFactor(p, randomUnit(random), corners, {1, -2, 1, 0.013f}, 0);
        ASSERT_TRUE(std::isfinite(f)) << p.x << ' ' << p.y << ' ' << p.z;
        ASSERT_GE(f, 0);
        ASSERT_LE(f, 4.01f);
        EXPECT_EQ(
            io::polygonVectorFactor(vec3(p.x, p.y, -std::abs(p.z)), {0, 0, 1}, corners, {0, 0, 1, 0}, 0), 0);
        EXPECT_LT(io::polygonVectorFactor(vec3(p.x, p.y, 0), {0, 0, 1}, corners, {0, 0, 1, 0}, 0), 1e-6f);
    }
}

// On a wall that ends where the polygon does: pixels nearer to the crease than their width are as light as
// it.
TEST(FormFactors, CreasesAreAsLightAsWhatIsAPixelAway) {
    glm::vec2 corners[8];
    std::ranges::copy(kSquare, corners);
    const float edge = kSquare[0].x > 0 ? kSquare[0].x : -kSquare[0].x, width = 0.005f;
    const auto factor = [&](float height, const vec3& n) {
        return io::polygonVectorFactor({-edge - 1e-4f, 0, height}, n, corners, {0, 0, 1, 0}, width);
    };
    const float away = factor(width, {1, 0, 0});
    EXPECT_GT(away, 0.3f);
    for (const float height : {3e-4f, 1e-6f, 0.0f, -1e-6f, -3e-4f})
        EXPECT_FLOAT_EQ(factor(height, {1, 0, 0}), away) << height;
    EXPECT_EQ(factor(-2 * width, {1, 0, 0}), 0) << "behind the plane";
    EXPECT_EQ(io::polygonVectorFactor({-edge - 1e-4f, 0, -0.04f}, {1, 0, 0}, corners, {0, 0, 1, 0}, 0.1f), 0)
        << "behind a thin wall, however wide the pixel";
    EXPECT_EQ(factor(-1e-4f, {-1, 0, 0}), 0) << "beyond a convex edge";
    EXPECT_EQ(factor(0, {0, 0, 1}), 0) << "in the plane";
}

TEST(FormFactors, LayersBelowAreThoseOfALogisticDistribution) {
    constexpr float kThickness = 0.3f;
    const double unit = double(kThickness) * std::sqrt(3.0) / std::numbers::pi, step = 1e-3;
    for (const double z : {-1.5, -0.4, 0.0, 0.1, 0.7, 4.0}) {
        double share = 0, depth = 0, square = 0;
        for (double h = -12; h < 12; h += step) {
            const double density = 1 / (4 * unit * std::pow(std::cosh(h / (2 * unit)), 2));
            square += h * h * density * step;
            if (h > z) continue;
            share += density * step;
            depth += (z - h) * density * step;
        }
        EXPECT_NEAR(std::sqrt(square), double(kThickness), 1e-3);
        const glm::vec2 layers = io::layersBelow(float(z), kThickness);
        EXPECT_NEAR(double(layers.x), share, 2e-3) << z;
        EXPECT_NEAR(double(layers.y), depth / share, 2e-3 * (1 + depth / share)) << z;
    }
    EXPECT_EQ(io::layersBelow(-100, kThickness).x, 0);
    EXPECT_NEAR(io::layersBelow(100, kThickness).y, 100, 1e-3f);
}

// Two steps as one light, and a wall beside them: between the steps it sees the lower one alone.
TEST(FormFactors, AReceiverAmongTheLayersSeesThoseBelow) {
    constexpr float kRise = 0.2f, kSide = 0.4f;
    glm::vec2 corners[8];
    std::ranges::copy(kSquare, corners);
    const auto step = [](dvec3 x, double height) {
        const auto place = [&](double u, double v) {
            return dvec3((u - 0.5) * double(kSide), (v - 0.5) * double(kSide), height);
        };
        return quadrature(x, {1, 0, 0}, {0, 0, 1}, 200, place, double(kSide * kSide)) / 2;
    };
    double plane = 0, layered = 0;
    for (float z = -0.09f; z < 0.3f; z += 0.03f) {
        const vec3 p(-0.25f, 0.02f, z);
        const double truth = step(p, -0.5 * double(kRise)) + step(p, 0.5 * double(kRise));
        const auto off = [&](const vec3& at, float share) {
            const double f = double(io::polygonVectorFactor(at, {1, 0, 0}, corners, {0, 0, 1, 0}, 0));
            return std::pow(f * double(share) - truth, 2);
        };
        const glm::vec2 layers = io::layersBelow(z, 0.5f * kRise);
        plane += off(p, 1);
        layered += off({p.x, p.y, layers.y}, layers.x);
    }
    std::cout << "two steps as one light: squared error " << plane << ", in layers " << layered << '\n';
    EXPECT_LT(layered, 0.4 * plane);
}

// A half sphere lit from outside, as one light: its inside is behind it, places above and beside it are not.
TEST(FormFactors, TheInsideOfADomeIsBehindIt) {
    constexpr float kRadius = 2, kThick = 0.2f;
    // Heights are spread evenly from 0 to the radius; the outline is a disk.
    const float thickness = kRadius / std::sqrt(12.0f), top = 0.5f * kRadius;
    const float secondMoment = 0.25f * kRadius * kRadius;
    glm::vec2 corners[8];
    for (int i = 0; i < 8; ++i)
        corners[i] = kRadius * glm::vec2(std::cos(float(i) * 0.7853982f), std::sin(float(i) * 0.7853982f));
    const auto outside = [&](vec3 p) { return io::outsideBulge(p, corners, top, thickness, secondMoment); };
    for (float angle = 0.05f; angle < 1.57f; angle += 0.1f) {
        const vec3 on(std::cos(angle), 0, std::sin(angle));
        const vec3 centre(0, 0, -top);  // the light's plane is through the middle of the heights
        EXPECT_EQ(outside(centre + (kRadius - kThick) * on), 0) << angle;
    }
    EXPECT_EQ(outside({0, 0, -top}), 0) << "the floor";
    EXPECT_EQ(outside({0, 0, top + thickness}), 1);
    EXPECT_EQ(outside({1.5f * kRadius, 0, 0.1f}), 1);
}

TEST(Sampling, HaltonFillsTheSquareEvenly) {
    std::array<int, 64> cells{};
    for (uint32_t i = 1; i <= 6400; ++i) {
        const glm::vec2 p = io::halton23(i);
        ASSERT_TRUE(p.x >= 0 && p.x < 1 && p.y >= 0 && p.y < 1);
        ++cells[size_t(p.x * 8) + 8 * size_t(p.y * 8)];
    }
    for (int count : cells)
        EXPECT_NEAR(count, 100, 6);
    EXPECT_FLOAT_EQ(io::halton23(1).x, 0.5f);
    EXPECT_FLOAT_EQ(io::halton23(1).y, 1.0f / 3);
    EXPECT_FLOAT_EQ(io::halton23(6).x, 0.375f);
}

}  // namespace
}  // namespace ag
