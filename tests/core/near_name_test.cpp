#include "engine/core/near_name.h"

#include <gtest/gtest.h>

#include <array>

namespace ag {
namespace {

constexpr std::array<std::string_view, 4> kNames = {"cornell", "corner", "corridor", "afterglow-bounces"};

TEST(NearName, FindsWhatWasMeant) {
    EXPECT_EQ(nearestName("cornel", kNames), "cornell");
    EXPECT_EQ(nearestName("cornre", kNames), "corner") << "swapped";
    EXPECT_EQ(nearestName("coridor", kNames), "corridor") << "dropped";
    EXPECT_EQ(nearestName("afterglow-bounce", kNames), "afterglow-bounces");
    EXPECT_EQ(nearestName("afterglow_bounces", kNames), "afterglow-bounces") << "changed";
}

TEST(NearName, OffersNothingThatIsFar) {
    EXPECT_EQ(nearestName("sponza", kNames), "");
    EXPECT_EQ(nearestName("", kNames), "");
    EXPECT_EQ(nearestName("cornell", {}), "");
    EXPECT_EQ(nearestName(std::string(100'000, 'c'), kNames), "");
}

TEST(NearName, SaysItInOneSentence) {
    EXPECT_EQ(missingName("scene", "corneer", std::span(kNames).first(2)),
              "there is no scene 'corneer'; did you mean 'corner'? (there are: cornell, corner)");
    EXPECT_EQ(missingName("scene", "xyz", std::span(kNames).first(2)),
              "there is no scene 'xyz' (there are: cornell, corner)");
}

}  // namespace
}  // namespace ag
