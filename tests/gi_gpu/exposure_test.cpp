// Automatic exposure against the same mean taken of the pixels read back.
#include <gtest/gtest.h>

#include "common/tonemap.h"
#include "exposure/exposure_io.h"
#include "tests/gi_gpu/bench.h"
#include "tools/scenegen/scenes.h"

namespace ag::gi {
using namespace render;
namespace {

struct Metered : Bench {
    Metered() : Bench(*scenegen::buildScene("cornell", 0), {96, 64}) {
        settings.exposure.automatic = true;
        output = [](GraphScope scope, const RenderFrame& frame) {
            if (frame.outputs.exposure) scope.output(frame.outputs.exposure);
        };
    }
};

void scaleLights(Bench& b, float factor) {
    for (RenderLight& light : b.scene.lights)
        light.intensity *= factor;
    ++b.scene.lightsVersion;
}

float stopsOf(Bench& b) {
    return readExposure(b.renderer, b.last.outputs.exposure);
}

// Sorted, not binned.
double wantedStops(const Image& radiance) {
    std::vector<double> logs;
    for (const glm::vec3& p : radiance.pixels)
        if (luminanceOf(p) > 0) logs.push_back(std::log2(double(luminanceOf(p))));
    std::ranges::sort(logs);
    const double begin = io::kDarkestShare * double(logs.size()),
                 end = (1 - io::kBrightestShare) * double(logs.size());
    double sum = 0;
    for (size_t i = 0; i < logs.size(); ++i)
        sum += logs[i] * std::max(std::min(double(i) + 1, end) - std::max(double(i), begin), 0.0);
    return std::log2(double(io::kMiddleGray)) - sum / (end - begin);
}

TEST(Exposure, BringsTheMeanToMiddleGray) {
    Metered b;
    b.settings.composite.exposure = 0.5f;
    for (int i = 0; i < 160; ++i)
        b.frame();
    const Image radiance = readImage(b.renderer, b.last.outputs.radiance),
                display = readImage(b.renderer, b.last.outputs.display);
    const float stops = stopsOf(b);
    EXPECT_NEAR(stops, wantedStops(radiance) + 0.5, 0.03);
    for (size_t i = 0; i < radiance.pixels.size(); ++i) {
        const glm::vec3 shown =
            io::applyTonemap(radiance.pixels[i], std::exp2(stops), uint32_t(b.settings.composite.tonemap));
        for (int k = 0; k < 3; ++k)
            ASSERT_NEAR(display.pixels[i][k], shown[k], 1.1 / 255) << i;
    }
}

TEST(Exposure, IsTheSamePictureUnderAThousandTimesTheLight) {
    Metered b;
    b.frame();
    const Image before = readImage(b.renderer, b.last.outputs.display);
    scaleLights(b, 1024);
    for (int i = 0; i < 160; ++i)
        b.frame();
    const Image bright = readImage(b.renderer, b.last.outputs.display);
    scaleLights(b, 1 / 1024.0f);
    for (int i = 0; i < 160; ++i)
        b.frame();
    const Image after = readImage(b.renderer, b.last.outputs.display);
    EXPECT_NEAR(meanOf(bright), meanOf(after), 0.01);
    EXPECT_NEAR(meanOf(before), meanOf(after), 0.05) << "the first frame is lit already";
    EXPECT_GT(meanOf(after), 0.15);
    EXPECT_LT(meanOf(after), 0.6);
}

TEST(Exposure, FollowsWithoutOvershootAndThenRests) {
    Metered b;
    for (int i = 0; i < 300; ++i)
        b.frame();
    const float first = stopsOf(b);
    EXPECT_EQ(b.passesRun(), 0);
    scaleLights(b, 16);
    float before = first;
    std::vector<float> way;
    for (int i = 0; i < 300; ++i) {
        b.frame();
        way.push_back(stopsOf(b));
        // Light itself settles for some frames; what is left is a hundredth of a stop.
        EXPECT_LT(way.back(), before + 0.02f) << i;
        before = way.back();
    }
    EXPECT_NEAR(way.back(), first - 4, 0.05);
    EXPECT_NEAR(way[24], first - 4, 0.1) << "a second at 25 frames a second";
    EXPECT_EQ(b.passesRun(), 0);
}

// What changes while nothing in the scene does must not stop halfway.
TEST(Exposure, FollowsTheSettingsOfAStillScene) {
    Metered b;
    for (int i = 0; i < 300; ++i)
        b.frame();
    const float before = stopsOf(b);
    b.settings.composite.exposure += 2;
    for (int i = 0; i < 120; ++i)
        b.frame();
    EXPECT_NEAR(stopsOf(b), before + 2, 0.001);
    EXPECT_EQ(b.passesRun(), 0);
}

TEST(Exposure, KeepsItsLimits) {
    Metered b;
    b.settings.exposure.least = 3;
    b.settings.exposure.most = 3;
    b.frame();
    EXPECT_EQ(stopsOf(b), 3);
    scaleLights(b, 0);
    b.settings.exposure.most = 16;
    for (int i = 0; i < 60; ++i)
        b.frame();
    EXPECT_EQ(stopsOf(b), 3) << "black asks for nothing";
}

TEST(Exposure, SkippingChangesNoBit) {
    float stops[2];
    for (const bool skip : {true, false}) {
        Metered b;
        b.options.skip = skip;
        b.settings.exposure.settleFrames = 12;  // rests before the end
        for (int i = 0; i < 40; ++i) {
            if (i == 10) scaleLights(b, 4);
            b.frame();
        }
        stops[skip] = stopsOf(b);
    }
    EXPECT_EQ(stops[0], stops[1]);
}

TEST(Exposure, ByHandMakesNoPass) {
    Bench b(*scenegen::buildScene("cornell", 0), {96, 64});
    b.frame();
    EXPECT_FALSE(b.last.outputs.exposure);
    EXPECT_EQ(b.outcome("exposure.meter"), PassOutcome::kDropped);
}

}  // namespace
}  // namespace ag::gi
