// The tone curves as they ship: grey stays grey, more light is never darker, colours stay in the display's
// range.
#include "common/tonemap.h"

#include <gtest/gtest.h>

namespace ag {
namespace {

using glm::vec3;
constexpr uint32_t kNone = 0, kNeutral = 3, kAgx = 4, kCurves = 5;

float grey(uint32_t mode, float light) {
    return io::linearFromSrgb1(io::applyTonemap(vec3(light), 1, mode).x);
}

TEST(Tonemap, MoreLightIsNeverDarker) {
    for (uint32_t mode = kNone; mode < kCurves; ++mode) {
        float before = -1;
        for (float stops = -14; stops < 10; stops += 0.125f) {
            const vec3 c = io::applyTonemap(vec3(std::exp2(stops)), 1, mode);
            EXPECT_NEAR(c.x, c.y, 2e-3) << mode << ' ' << stops;
            EXPECT_NEAR(c.x, c.z, 2e-3) << mode << ' ' << stops;
            EXPECT_GE(c.x, before - 1e-4f) << mode << ' ' << stops;
            EXPECT_LE(c.x, 1);
            before = c.x;
        }
    }
}

TEST(Tonemap, BlackAndNonsenseStayInRange) {
    for (uint32_t mode = kNone; mode < kCurves; ++mode)
        for (const vec3 c : {vec3(0), vec3(-1), vec3(1e30f), vec3(1e30f, 0, 0), vec3(0, 1e-30f, 5)}) {
            const vec3 shown = io::applyTonemap(c, 1, mode);
            for (int k = 0; k < 3; ++k) {
                EXPECT_GE(shown[k], 0) << mode;
                EXPECT_LE(shown[k], 1) << mode;
            }
            if (c == vec3(0)) {
                EXPECT_LT(shown.x, 0.02f) << mode;
            }
        }
}

// A colour between 0.08 and 0.8 minus 0.04, exactly, whatever its hue.
TEST(Tonemap, NeutralLeavesColoursAsTheyAre) {
    for (const vec3 c : {vec3(0.5f), vec3(0.2f, 0.6f, 0.1f), vec3(0.7f, 0.1f, 0.3f)})
        for (int k = 0; k < 3; ++k)
            EXPECT_NEAR(io::linearFromSrgb1(io::applyTonemap(c, 1, kNeutral)[k]), c[k] - 0.04f, 1e-4);
    EXPECT_NEAR(grey(kNeutral, 0.8f), 0.76f, 1e-4) << "where compression begins, no step";
    EXPECT_NEAR(grey(kNeutral, 0.8001f), 0.7601f, 2e-4);
}

// Middle grey of AgX's base look, and bright saturated colours that pale.
TEST(Tonemap, AgxHasItsMiddleGreyAndPales) {
    // Its sigmoid brings 0.18 to 0.18 of a display of exponent 2.4; the fit is shown by one of 2.2.
    EXPECT_NEAR(grey(kAgx, 0.18f), std::pow(0.18f, 2.2f / 2.4f), 0.01f);
    const auto paleness = [](float light) {
        const vec3 c = io::applyTonemap(vec3(light, 0.02f * light, 0.02f * light), 1, kAgx);
        return c.y / c.x;
    };
    EXPECT_GT(paleness(64), 2 * paleness(0.5f));
}

}  // namespace
}  // namespace ag
