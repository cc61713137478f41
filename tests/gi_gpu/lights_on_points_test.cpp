// Lights without a reflective shadow map: what bounces of them comes from points of surfaces.
#include <gtest/gtest.h>

#include "tests/gi_gpu/bench.h"
#include "tools/scenegen/scenes.h"

namespace ag::gi {
using namespace render;
namespace {

constexpr glm::uvec2 kSize{96, 64};

struct Bounced : Bench {
    explicit Bounced(bool map) : Bench(*scenegen::buildScene("cornell", 0), kSize) {
        settings.bounce.laterBounces.enabled = true;
        settings.bounce.valClustering.count = 256;
        settings.bounce.texelRays.enabled = false;
        for (RenderLight& light : scene.lights)
            light.bounces = map;
        output = [](GraphScope scope, const RenderFrame& f) { scope.output(f.bounce.irradiance.image); };
    }
    Image after(int count) {
        for (int i = 0; i < count; ++i)
            frame();
        return readImage(renderer, last.bounce.irradiance.image);
    }
};

// Relative to the truth's mean.
double rmse(const Image& image, const Image& truth) {
    double sum = 0;
    for (size_t i = 0; i < truth.pixels.size(); ++i) {
        const double d = double(luminanceOf(image.pixels[i] - truth.pixels[i]));
        sum += d * d;
    }
    return std::sqrt(sum / double(truth.pixels.size())) / meanOf(truth);
}

TEST(LightsOnPoints, BounceAsThoseWithAMap) {
    const Image mapped = Bounced(true).after(44), points = Bounced(false).after(44);
    std::printf("mean ratio %.3f, RMSE of the mean %.3f\n", meanOf(points) / meanOf(mapped),
                rmse(points, mapped));
    EXPECT_NEAR(meanOf(points) / meanOf(mapped), 1, 0.05);
    EXPECT_LT(rmse(points, mapped), 0.25);
}

TEST(LightsOnPoints, ManyAreAsBrightAsOne) {
    const Image one = Bounced(false).after(44);
    Bounced b(false);
    const RenderLight whole = b.scene.lights[0];
    b.scene.lights.clear();
    constexpr uint32_t kLights = 40;
    for (uint32_t i = 0; i < kLights; ++i) {
        b.scene.lights.push_back(whole);
        b.scene.lights.back().intensity /= float(kLights);
        b.scene.lights.back().id = i + 1;
    }
    ++b.scene.lightsVersion;
    const Image many = b.after(44);
    EXPECT_NEAR(meanOf(many) / meanOf(one), 1, 0.03) << "some of the faint ones stand for the others";
}

TEST(LightsOnPoints, RestWhenNothingChangesAndAreLeftOutWithoutLaterBounces) {
    Bounced b(false);
    b.after(160);
    EXPECT_EQ(b.passesRun(), 0);
    b.settings.bounce.laterBounces.enabled = false;
    b.output = nullptr;
    b.frame();
    EXPECT_EQ(b.outcome("later_bounces.lights"), PassOutcome::kDropped);
}

TEST(LightsOnPoints, SkippingChangesNoBit) {
    std::vector<glm::vec3> pixels[2];
    for (const bool skip : {true, false}) {
        Bounced b(false);
        b.options.skip = skip;
        b.after(6);
        b.scene.lights[0].intensity *= 0.5f;
        ++b.scene.lightsVersion;
        pixels[skip] = b.after(20).pixels;
    }
    EXPECT_EQ(pixels[0], pixels[1]);
}

}  // namespace
}  // namespace ag::gi
