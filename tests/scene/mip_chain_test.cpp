#include "engine/scene/mip_chain.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "shaders/common/tonemap.h"

namespace ag {
namespace {

constexpr uint32_t kSide = 64;

std::vector<uint8_t> randomTexels() {
    std::mt19937 random(5);
    std::vector<uint8_t> texels(kSide * kSide * 4);
    for (uint8_t& t : texels)
        t = uint8_t(random() & 255u);
    return texels;
}

// Of a channel over a square of the finest level, a code with its fraction.
double meanCode(const std::vector<uint8_t>& texels, uint32_t x0, uint32_t y0, uint32_t side, uint32_t channel,
                bool srgb) {
    double sum = 0;
    for (uint32_t y = y0; y < y0 + side; ++y)
        for (uint32_t x = x0; x < x0 + side; ++x) {
            const float share = float(texels[(y * kSide + x) * 4 + channel]) / 255;
            sum += double(srgb ? io::linearFromSrgb1(share) : share);
        }
    const auto mean = float(sum / (side * side));
    return 255 * double(srgb ? io::srgbFromLinear1(mean) : mean);
}

TEST(MipChain, EachTexelIsTheMeanOfTheFinestOnesItCovers) {
    const std::vector<uint8_t> texels = randomTexels();
    for (const TexelCodes codes : {TexelCodes::kLinear, TexelCodes::kSrgb}) {
        const std::vector<uint8_t> chain = mipChain(texels, kSide, codes);
        ASSERT_EQ(mipCount(kSide), 7u);
        ASSERT_EQ(chain.size(), (64u * 64 + 32 * 32 + 16 * 16 + 8 * 8 + 4 * 4 + 2 * 2 + 1) * 4);
        EXPECT_TRUE(std::equal(texels.begin(), texels.end(), chain.begin()));
        size_t at = texels.size();
        double worst = 0;
        for (uint32_t covers = 2; covers <= kSide; covers *= 2)
            for (uint32_t y = 0; y < kSide; y += covers)
                for (uint32_t x = 0; x < kSide; x += covers)
                    for (uint32_t channel = 0; channel < 4; ++channel) {
                        const bool srgb = codes == TexelCodes::kSrgb && channel < 3;
                        const double mean = meanCode(texels, x, y, covers, channel, srgb);
                        worst = std::max(worst, std::abs(double(chain[at++]) - mean));
                    }
        EXPECT_EQ(at, chain.size());
        EXPECT_LT(worst, 0.51);
    }
}

TEST(MipChain, EveryCodeStaysItself) {
    for (const TexelCodes codes : {TexelCodes::kLinear, TexelCodes::kSrgb})
        for (uint32_t code = 0; code < 256; ++code) {
            const std::vector<uint8_t> texels(4 * 4 * 4, uint8_t(code));
            for (const uint8_t c : mipChain(texels, 4, codes))
                ASSERT_EQ(c, code);
        }
}

}  // namespace
}  // namespace ag
