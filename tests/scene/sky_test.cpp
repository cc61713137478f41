// Skies as pictures: places and directions, what they hold, the analytic one against its paper's formulas.
#include "engine/scene/sky.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace ag {
namespace {

TEST(Sky, PlacesAndDirectionsAreEachOthersInverse) {
    for (int i = 0; i < 1000; ++i) {
        const glm::vec2 place((float(i % 37) + 0.3f) / 37, (float(i % 29) + 0.4f) / 29);
        const glm::vec2 again = skyPlace(skyDirection(place));
        EXPECT_NEAR(again.x, place.x, 1e-5f);
        EXPECT_NEAR(again.y, place.y, 1e-5f);
    }
    EXPECT_NEAR(skyPlace({0, 1, 0}).y, 0, 1e-6f) << "rows begin at the zenith";
    EXPECT_NEAR(skyPlace({1, 0, 0}).x, 0.5f, 1e-6f);
    EXPECT_NEAR(skyPlace({0, 0, 1}).x, 0.75f, 1e-6f);
}

TEST(Sky, TexelsCoverTheSphere) {
    double sum = 0;
    for (int y = 0; y < 33; ++y)
        sum += 70 * double(skyTexelAngle({70, 33}, y));
    EXPECT_NEAR(sum, 4 * std::numbers::pi, 1e-4);
}

TEST(Sky, RadianceIsInterpolatedAndGoesRound) {
    Sky sky{Image(4, 2)};
    for (int x = 0; x < 4; ++x)
        sky.radiance.at(x, 0) = sky.radiance.at(x, 1) = glm::vec3(float(x));
    const auto at = [&](float x) { return skyRadiance(sky, skyDirection({x / 4, 0.5f})).x; };
    EXPECT_NEAR(at(1.5f), 1, 1e-4f) << "a texel's middle";
    EXPECT_NEAR(at(2), 1.5f, 1e-4f);
    EXPECT_NEAR(at(3.999f), 1.5f, 1e-2f) << "between the last and the first";
    EXPECT_EQ(skyRadiance(constantSky({1, 2, 3}), {0.6f, 0, -0.8f}), glm::vec3(1, 2, 3));
}

// Preetham et al. 1999, the zenith's luminance at turbidity 3 with the sun 45 degrees high: 5.9 kcd/m² by
// their equation.
TEST(Sky, AnalyticZenithIsThePapers) {
    const float theta = std::numbers::pi_v<float> / 4, turbidity = 3;
    const Sky sky = analyticSky(glm::normalize(glm::vec3(1, -1, 0)), turbidity);
    const double chi = (4.0 / 9 - double(turbidity) / 120) * (std::numbers::pi - 2 * double(theta));
    const double kilocandela = (4.0453 * 3 - 4.9710) * std::tan(chi) - 0.2155 * 3 + 2.4192;
    const glm::vec3 rgb = skyRadiance(sky, {0, 1, 0});
    const double luminance = 0.2126 * double(rgb.x) + 0.7152 * double(rgb.y) + 0.0722 * double(rgb.z);
    EXPECT_NEAR(luminance, kilocandela * 1000 / 683, 0.03 * luminance);
    EXPECT_GT(rgb.z, rgb.x) << "it is blue";
}

TEST(Sky, AnalyticIsBrightestAboutTheSunAndDarkerFromTheGround) {
    const glm::vec3 sun = glm::normalize(glm::vec3(0.5f, -0.6f, -0.3f));
    const Sky sky = analyticSky(sun, 3);
    const auto bright = [&](glm::vec3 d) { return skyRadiance(sky, glm::normalize(d)).y; };
    EXPECT_GT(bright(-sun), 2 * bright({sun.x, -sun.y, sun.z}));
    EXPECT_GT(bright({0, -1, 0}), 0) << "there is ground";
    EXPECT_LT(bright({0, -1, 0}), 0.5f * bright({0, 1, 0}));
    for (const float turbidity : {kLeastTurbidity, kMostTurbidity})
        for (const float y : {-1.0f, -0.5f, -0.01f}) {
            const Sky any = analyticSky(glm::normalize(glm::vec3(0.3f, y, 0)), turbidity);
            EXPECT_EQ(whyNoSky(any.radiance), nullptr) << turbidity << ' ' << y;
        }
}

TEST(Sky, PicturesThatCannotBeOneAreRefused) {
    EXPECT_STREQ(whyNoSky(Image(64, 64)), "is not twice as wide as high");
    EXPECT_EQ(whyNoSky(Image(64, 32)), nullptr);
    for (const float bad : {-1.0f, NAN, INFINITY, 1e9f}) {
        Image picture(64, 32);
        picture.at(3, 4).y = bad;
        EXPECT_STREQ(whyNoSky(picture), "holds what is no radiance from 0 to 1e6") << bad;
    }
}

}  // namespace
}  // namespace ag
