// Which groups of lanes a device gets.
#include "engine/gpu/lanes.h"

#include <gtest/gtest.h>

namespace ag::gpu {
namespace {

TEST(Lanes, OfOneSizeAreUsedAsTheyAre) {
    EXPECT_EQ(chooseLanes({.usual = 8, .least = 8, .most = 8}, true), (Lanes{.count = 8}));
    EXPECT_EQ(chooseLanes({.usual = 4}, true), (Lanes{.count = 4}));  // a CPU of Vulkan 1.2
    EXPECT_EQ(chooseLanes({.usual = 32, .least = 32, .most = 32, .canBeRequested = true}, false),
              (Lanes{.count = 32}));
    EXPECT_EQ(chooseLanes({.usual = 64, .least = 64, .most = 64}, false), (Lanes{.count = 64}));
}

TEST(Lanes, OfSeveralSizesAreAskedFor) {
    // Intel, AMD, and one that has only large ones.
    EXPECT_EQ(chooseLanes({.usual = 32, .least = 8, .most = 32, .canBeRequested = true}, false),
              (Lanes{.count = 32, .requested = true}));
    EXPECT_EQ(chooseLanes({.usual = 64, .least = 32, .most = 64, .canBeRequested = true}, false),
              (Lanes{.count = 32, .requested = true}));
    EXPECT_EQ(chooseLanes({.usual = 64, .least = 64, .most = 128, .canBeRequested = true}, false),
              (Lanes{.count = 64, .requested = true}));
}

TEST(Lanes, ShareMemoryWhereNoSizeIsCertain) {
    EXPECT_EQ(chooseLanes({.usual = 32, .least = 8, .most = 32}, false),
              (Lanes{.count = 32, .shared = true}));
    EXPECT_EQ(chooseLanes({.usual = 32}, false), (Lanes{.count = 32, .shared = true}));
    EXPECT_EQ(chooseLanes({.usual = 1, .least = 1, .most = 1}, true), (Lanes{.count = 32, .shared = true}));
    EXPECT_EQ(chooseLanes({.usual = 128, .least = 128, .most = 128, .canBeRequested = true}, false),
              (Lanes{.count = 32, .shared = true}));
}

}  // namespace
}  // namespace ag::gpu
