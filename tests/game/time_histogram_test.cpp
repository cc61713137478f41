#include "game/time_histogram.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace ag::game {
namespace {

TEST(TimeHistogram, HasTheQuantilesOfWhatWasAdded) {
    TimeHistogram times;
    EXPECT_EQ(times.quantile(0.5), 0);
    for (int i = 1; i <= 10000; ++i)
        times.add(0.01 * i);
    EXPECT_EQ(times.count(), 10000u);
    for (const double q : {0.01, 0.5, 0.9, 0.99})
        EXPECT_NEAR(times.quantile(q), 100 * q, q);
    times.clear();
    EXPECT_EQ(times.count(), 0u);
    EXPECT_EQ(times.quantile(0.99), 0);
}

TEST(TimeHistogram, TakesWhatIsNoTimeAndWhatIsBeyondItsEnds) {
    TimeHistogram times;
    for (const double ms : {0.0, -1.0, std::nan("")})
        times.add(ms);
    EXPECT_EQ(times.count(), 0u);
    times.add(1e-9);
    times.add(std::numeric_limits<double>::infinity());
    EXPECT_EQ(times.count(), 2u);
    EXPECT_LT(times.quantile(0), 2e-4);
    EXPECT_GT(times.quantile(1), 1e6);
}

}  // namespace
}  // namespace ag::game
