#include "engine/core/settings.h"

#include <gtest/gtest.h>

namespace ag {
namespace {

enum class Shape : uint32_t { kPoint, kDisk };

struct Values {
    uint32_t count = 256;
    float weight = 1.5f;
    bool skip = true;
    Shape shape = Shape::kPoint;
};

struct SettingsTest : testing::Test {
    Values v;
    Settings s;
    void SetUp() override {
        s.add({"clusters", "count", 16, 1024, "clusters", "how many"}, &v.count);
        s.add({"clusters", "weight", 0, 10, "", "distance"}, &v.weight);
        s.add({"engine", "skip", 0, 0, "", "leave out"}, &v.skip);
        s.add({"shading", "shape", 0, 0, "", "form factor", {"point", "disk"}}, &v.shape);
    }
    std::string fault(const char* assignment) {
        const Status result = s.set(assignment);
        return result ? "" : result.error().message;
    }
};

TEST_F(SettingsTest, SetsEveryKind) {
    EXPECT_EQ(fault("clusters.count=64"), "");
    EXPECT_EQ(fault("clusters.weight=0.25"), "");
    EXPECT_EQ(fault("engine.skip=off"), "");
    EXPECT_EQ(fault("shading.shape=disk"), "");
    EXPECT_EQ(v.count, 64u);
    EXPECT_EQ(v.weight, 0.25f);
    EXPECT_FALSE(v.skip);
    EXPECT_EQ(v.shape, Shape::kDisk);
}

TEST_F(SettingsTest, RefusesWithASentenceAndKeepsTheValue) {
    EXPECT_NE(fault("clusters.cuont=64").find("did you mean 'clusters.count'"), std::string::npos);
    EXPECT_NE(fault("clusters.count=8").find("16..1024"), std::string::npos);
    EXPECT_NE(fault("clusters.count=64.5").find("whole number"), std::string::npos);
    EXPECT_NE(fault("clusters.count=many").find("not 'many'"), std::string::npos);
    EXPECT_NE(fault("clusters.weight=nan"), "");
    EXPECT_NE(fault("shading.shape=square").find("point|disk"), std::string::npos);
    EXPECT_NE(fault("engine.skip"), "");
    EXPECT_EQ(v.count, 256u);
    EXPECT_EQ(v.weight, 1.5f);
}

TEST_F(SettingsTest, Lists) {
    EXPECT_NE(s.table().find("clusters.count"), std::string::npos);
}

}  // namespace
}  // namespace ag
