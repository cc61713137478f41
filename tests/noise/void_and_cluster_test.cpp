// Blue noise: every rank once, the same from equal seeds, and little of it in low frequencies.
#include "tools/noise/void_and_cluster.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "common/sampling.h"

namespace ag::noise {
namespace {

constexpr uint32_t kSide = 32;

// Mean power of the frequencies up to `most` cycles a side, over that of all of them.
double lowShare(const std::vector<uint32_t>& ranks, int most) {
    const double count = kSide * kSide, mean = (count - 1) / 2;
    double low = 0, all = 0;
    int lows = 0, alls = 0;
    for (int v = 0; v < int(kSide); ++v)
        for (int u = 0; u < int(kSide); ++u) {
            if (u == 0 && v == 0) continue;
            std::complex<double> sum = 0;
            for (uint32_t i = 0; i < ranks.size(); ++i) {
                const double turns = double(u * int(i % kSide) + v * int(i / kSide)) / kSide;
                sum += (double(ranks[i]) - mean) / count * std::polar(1.0, -2 * std::numbers::pi * turns);
            }
            const int fu = std::min(u, int(kSide) - u), fv = std::min(v, int(kSide) - v);
            all += std::norm(sum);
            ++alls;
            if (fu * fu + fv * fv > most * most) continue;
            low += std::norm(sum);
            ++lows;
        }
    return low / lows / (all / alls);
}

TEST(VoidAndCluster, RanksEveryPixelOnce) {
    const std::vector<uint32_t> ranks = voidAndCluster(kSide, 1);
    EXPECT_EQ(ranks, voidAndCluster(kSide, 1));
    EXPECT_NE(ranks, voidAndCluster(kSide, 2));
    std::vector<uint32_t> sorted = ranks;
    std::ranges::sort(sorted);
    for (uint32_t i = 0; i < sorted.size(); ++i)
        ASSERT_EQ(sorted[i], i);
}

TEST(VoidAndCluster, HasLittleLowFrequency) {
    std::vector<uint32_t> white(kSide * kSide);
    for (uint32_t i = 0; i < white.size(); ++i)
        white[i] = i;
    std::ranges::sort(white, {}, [](uint32_t i) { return io::hashUint(i); });
    const double blue = lowShare(voidAndCluster(kSide, 1), 5), other = lowShare(white, 5);
    std::printf("mean power up to 5 cycles over that of all: blue %.3f, white %.3f\n", blue, other);
    EXPECT_LT(blue, 0.1);
    EXPECT_GT(other, 0.6);
}

}  // namespace
}  // namespace ag::noise
