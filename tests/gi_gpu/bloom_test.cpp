// Bloom spreads light and adds none.
#include <gtest/gtest.h>

#include "tests/gi_gpu/bench.h"
#include "tools/scenegen/scenes.h"

namespace ag::gi {
using namespace render;
namespace {

struct Bloomed : Bench {
    explicit Bloomed(float share) : Bench(*scenegen::buildScene("cornell", 0), {96, 64}) {
        settings.technique = Technique::kNone;
        settings.bloom.share = share;
        output = [this](GraphScope scope, const RenderFrame& frame) {
            picture = share_ > 0 ? scope.findImage("bloom.picture") : frame.outputs.radiance;
            scope.output(picture);
        };
        share_ = share;
    }
    Image after() {
        frame();
        return readImage(renderer, picture);
    }
    ImageHandle picture;
    float share_ = 0;
};

TEST(Bloom, SpreadsLightAndAddsNone) {
    const Image plain = Bloomed(0).after(), bloomed = Bloomed(0.3f).after();
    // What leaves at the picture's sides comes back as the outermost pixels again.
    EXPECT_NEAR(meanOf(bloomed) / meanOf(plain), 1, 0.02);
    float brightest = 0, darkest = 1e30f, brightestPlain = 0, darkestPlain = 1e30f;
    for (size_t i = 0; i < plain.pixels.size(); ++i) {
        brightest = std::max(brightest, luminanceOf(bloomed.pixels[i]));
        darkest = std::min(darkest, luminanceOf(bloomed.pixels[i]));
        brightestPlain = std::max(brightestPlain, luminanceOf(plain.pixels[i]));
        darkestPlain = std::min(darkestPlain, luminanceOf(plain.pixels[i]));
    }
    EXPECT_LT(brightest, 0.95f * brightestPlain);
    EXPECT_GT(darkest, darkestPlain + 0.01f * float(meanOf(plain)));
}

TEST(Bloom, StaysOutOfRadianceAndRests) {
    Bloomed without(0), with(0.2f);
    without.after(), with.after();
    EXPECT_EQ(readImage(with.renderer, with.last.outputs.radiance).pixels,
              readImage(without.renderer, without.last.outputs.radiance).pixels);
    EXPECT_NE(readImage(with.renderer, with.last.outputs.display).pixels,
              readImage(without.renderer, without.last.outputs.display).pixels);
    for (int i = 0; i < 3; ++i)
        with.frame();
    EXPECT_EQ(with.passesRun(), 0);
    EXPECT_EQ(without.outcome("bloom.half0"), PassOutcome::kDropped);
}

}  // namespace
}  // namespace ag::gi
