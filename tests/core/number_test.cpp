#include "engine/core/number.h"

#include <gtest/gtest.h>

namespace ag {
namespace {

TEST(Number, IsFiniteAndAllOfTheText) {
    EXPECT_EQ(parseNumber("1.5"), 1.5);
    EXPECT_EQ(parseNumber("-2e3"), -2000.0);
    EXPECT_EQ(parseNumber("+4"), 4.0);
    for (const char* text :
         {"", " 1", "1 ", "1,5", "nan", "-nan", "inf", "-inf", "1e999", "0x10", "one", "++1", "1e"})
        EXPECT_FALSE(parseNumber(text)) << text;
}

TEST(Number, StaysInItsRange) {
    EXPECT_TRUE(parseNumber("3", 3, 4));
    EXPECT_TRUE(parseNumber("4", 3, 4, true));
    EXPECT_FALSE(parseNumber("3.5", 3, 4, true));
    EXPECT_FALSE(parseNumber("4.0001", 3, 4));
    EXPECT_FALSE(parseNumber("nan", 3, 4));
    EXPECT_EQ(numberFault("3.5", 3, 4), "");
    EXPECT_EQ(numberFault("nan", 3, 4, true), "'nan' is not a whole number from 3 to 4");
}

TEST(Number, Sizes) {
    EXPECT_EQ(*parseSize("640x360"), glm::uvec2(640, 360));
    EXPECT_EQ(*parseSize("1x8192"), glm::uvec2(1, 8192));
    for (const char* text :
         {"", "x", "640", "640x", "x360", "0x5", "5x0", "8193x1", "1.5x2", "1x2x3", "-1x5", "1x 2", "nanx1"})
        EXPECT_FALSE(parseSize(text)) << text;
}

}  // namespace
}  // namespace ag
