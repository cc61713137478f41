// FLIP on pictures small or plain enough to work out by hand.
#include "engine/core/flip.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ag {
namespace {

Image plain(glm::vec3 color, int width = 4, int height = 3) {
    Image image(width, height);
    for (glm::vec3& p : image.pixels)
        p = color;
    return image;
}

Image step(float left, float right, int edge, int width, int height) {
    Image image(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            image.at(x, y) = glm::vec3(x < edge ? left : right);
    return image;
}

TEST(Flip, EqualPicturesDoNotDiffer) {
    const Image image = step(0.1f, 0.8f, 9, 20, 5);
    for (const float e : flipLdr(image, image))
        EXPECT_EQ(e, 0);
    for (const float e : flipHdr(image, image))
        EXPECT_EQ(e, 0);
}

// Plain pictures pass the filters unchanged and have no features: only colour is left. White and black differ
// by 100 in lightness. Green (L 87.73, a -86.18, b 83.18) and blue (32.30, 79.19, -107.86), chroma scaled by
// L / 100, differ by 55.43 + |(101.19, 107.81)| = 203.29: the largest error is 203.29^0.7 = 41.27, the split
// 0.4 of it, 16.51. 100^0.7 = 25.12 lies beyond: 0.95 + 0.05 (25.12 - 16.51) / (41.27 - 16.51) = 0.9674.
TEST(Flip, BlackAgainstWhite) {
    for (const float e : flipLdr(plain(glm::vec3(0)), plain(glm::vec3(1))))
        EXPECT_NEAR(e, 0.9674f, 3e-4f);
}

TEST(Flip, GreenAgainstBlueIsTheWorst) {
    for (const float e : flipLdr(plain({0, 1, 0}), plain({0, 0, 1})))
        EXPECT_NEAR(e, 1, 1e-4f);
}

// Grey 0.5 and 0.4: L = 116 cbrt(Y) - 16 = 76.07 and 69.47; 6.60^0.7 = 3.747; 0.95 x 3.747 / 16.51 = 0.2156.
TEST(Flip, TwoGrays) {
    for (const float e : flipLdr(plain(glm::vec3(0.5f)), plain(glm::vec3(0.4f))))
        EXPECT_NEAR(e, 0.2156f, 1e-3f);
}

// Just right of a step from 0 to 1 the edge filter meets all its weights of one sign over the bright half:
// its response is 1 against 0 in a plain picture. The feature error is (1 / sqrt 2)^0.5 = 0.8409, so that the
// colour error c becomes c^0.1591. Far from the step only colour is left.
TEST(Flip, AStepIsAFeature) {
    const int edge = 40;
    const Image flat = plain(glm::vec3(0), 80, 60), stepped = step(0, 1, edge, 80, 60);
    const auto error = flipLdr(flat, stepped);
    const float farAway = error[size_t(30 * 80 + 79)];
    EXPECT_NEAR(farAway, 0.9674f, 3e-4f);
    EXPECT_NEAR(error[size_t(30 * 80)], 0, 1e-4f);
    // Two pixels to the dark side the colour error is smaller, yet the edge makes it count nearly whole.
    const float before = error[size_t(30 * 80 + edge - 1)];
    EXPECT_GT(before, 0.9f);
    const float at = error[size_t(30 * 80 + edge)];
    const float color = std::pow(at, 1 / (1 - 0.8409f));
    EXPECT_GT(color, 0.5f);
    EXPECT_LT(color, 0.97f);
}

// Constant pictures have one luminance: brightest = median, two equal exposures. The exposure takes the truth
// to 0.85 on the curve; half of it then lands at T(x / 2) where T(x) = 0.85.
TEST(Flip, HdrLooksAtTheRightExposure) {
    const Image truth = plain(glm::vec3(8)), test = plain(glm::vec3(4));
    const FlipExposures e = flipExposures(truth);
    EXPECT_EQ(e.count, 2);
    EXPECT_NEAR(e.first, e.last, 1e-5f);
    const auto curve = [](double x) {
        return (0.9036 * x * x + 0.018 * x) / (0.8748 * x * x + 0.354 * x + 0.14);
    };
    const double x = 8 * std::exp2(double(e.first));
    EXPECT_NEAR(curve(x), 0.85, 1e-4);
    const auto lightness = [](double y) { return 116 * std::cbrt(y) - 16; };
    const double expected =
        0.95 * std::pow(lightness(0.85) - lightness(curve(x / 2)), 0.7) / (0.4 * std::pow(203.29, 0.7));
    for (const float error : flipHdr(truth, test))
        EXPECT_NEAR(double(error), expected, 2e-3);
    // Brightness as such does not matter, only the ratio.
    for (const float error : flipHdr(plain(glm::vec3(8e-3f)), plain(glm::vec3(4e-3f))))
        EXPECT_NEAR(double(error), expected, 2e-3);
}

TEST(Flip, ExposuresSpanTheBrightestToTheMedian) {
    Image image = plain(glm::vec3(1), 10, 10);
    image.at(3, 3) = glm::vec3(32);
    const FlipExposures e = flipExposures(image);
    EXPECT_NEAR(e.last - e.first, 5, 1e-4f) << "32 is five stops over 1";
    EXPECT_EQ(e.count, 5);
    EXPECT_EQ(flipExposures(plain(glm::vec3(0))).count, 2) << "a black picture has no exposures of its own";
}

}  // namespace
}  // namespace ag
