// Points of things that come and go: only theirs change, none stays behind, and together they stand for all
// there is.
#include "engine/renderer/point_pool.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "engine/renderer/scene_surfaces.h"
#include "engine/scene/static_scene.h"
#include "tools/scenegen/scenes.h"

namespace ag::render {
namespace {

struct Pool {
    SceneAsset asset;
    RenderScene scene = staticScene(asset);
    PointPool points;

    Pool(const char* name, uint32_t param) : asset(*scenegen::buildScene(name, param)) {
        points.load(asset.geometry);
        points.start(scene, true, 1);
        clearChanges();
    }
    void clearChanges() {
        points.changedSamples.clear();
        points.changedAreas.clear();
        points.changedBounces.clear();
    }
    bool replace(uint32_t row, const RenderInstance& instance) {
        if (row >= scene.instances.size()) scene.instances.resize(row + 1, {.primitive = kNoPrimitive});
        scene.instances[row] = instance;
        const RenderScene::Range range{row, row + 1};
        return points.follow(scene, std::span(&range, 1));
    }
    std::map<uint32_t, double> areas() const {  // m² that an instance's points stand for
        std::map<uint32_t, double> areas;
        for (const io::SurfaceSample& s : points.samples())
            if (s.instance != io::kNoInstance) areas[s.instance] += double(points.pointAreas()[s.instance]);
        return areas;
    }
    double bounceArea() const {
        double sum = 0;
        for (const io::BouncePoint& p : points.bouncePoints().first(points.reflectingCount()))
            sum += double(p.area);
        return sum;
    }
};

size_t countOf(ChangedElements& changed) {
    size_t count = 0;
    for (const RenderScene::Range& range : changed.merged())
        count += range.end - range.begin;
    return count;
}

TEST(PointPool, WhatGoesTakesItsPointsAlong) {
    Pool p("cornell", 0);
    const auto before = p.areas();
    const double bounced = p.bounceArea();
    const uint64_t layout = p.points.layoutVersion(), still = p.points.staticVersion();
    const auto last = uint32_t(p.scene.instances.size() - 1);
    ASSERT_TRUE(p.replace(last, {.primitive = kNoPrimitive}));
    auto after = p.areas();
    EXPECT_EQ(after.count(last), 0u);
    for (const auto& [row, area] : after)
        EXPECT_EQ(area, before.at(row));
    EXPECT_EQ(p.points.layoutVersion(), layout);
    EXPECT_NE(p.points.staticVersion(), still);
    EXPECT_LT(countOf(p.points.changedSamples), p.points.samples().size() / 2) << "the walls stay";
    EXPECT_NEAR(p.bounceArea(), bounced - before.at(last), 0.02 * bounced);
}

TEST(PointPool, WhatComesHasThePointsOfItsMesh) {
    Pool p("cornell", 0);
    const auto row = uint32_t(p.scene.instances.size());
    RenderInstance guest = p.scene.instances.back();
    guest.movable = true;
    guest.worldFromLocal[0] *= 2.0f;  // twice as wide: boxes grow by their sides
    guest.worldFromLocal[3] += glm::vec3(0.3f);
    const double once = p.areas().at(row - 1);
    const uint64_t still = p.points.staticVersion();
    ASSERT_TRUE(p.replace(row, guest));
    EXPECT_NEAR(p.areas().at(row), once * 5 / 3, 0.05 * once);  // a cube: four of six sides
    p.clearChanges();
    ASSERT_TRUE(p.replace(row + 1, guest));
    EXPECT_LE(countOf(p.points.changedSamples), kMostMeshPoints);
    for (uint32_t i = 0; i < p.points.samples().size(); ++i)
        if (p.points.samples()[i].instance >= row && p.points.samples()[i].instance != io::kNoInstance) {
            EXPECT_GE(i, p.points.staticCount());
        }
    EXPECT_EQ(p.points.staticVersion(), still) << "nothing still came";
}

// Whenever they come: half of their points face either side, for the area of both.
TEST(PointPool, DoubleSidedThingsThatComeReflectToBothSides) {
    std::array<double, 2> added{};
    for (const bool doubleSided : {false, true}) {
        Pool p("furnace", 50);
        for (Material& m : p.asset.geometry.materials)
            m.doubleSided = doubleSided;
        RenderInstance guest = p.scene.instances.front();
        guest.movable = true;
        const auto row = uint32_t(p.scene.instances.size());
        ASSERT_TRUE(p.replace(row - 1, {.primitive = kNoPrimitive}));
        const double before = p.bounceArea();
        ASSERT_TRUE(p.replace(row, guest));
        added[doubleSided] = p.bounceArea() - before;
        double back = 0;
        for (const io::BouncePoint& b : p.points.bouncePoints().first(p.points.reflectingCount()))
            if (b.instance == row && glm::dot(b.positionLocal, b.normalLocal) > 0) back += double(b.area);
        EXPECT_NEAR(back / added[doubleSided], doubleSided ? 0.5 : 0, 0.02);
    }
    EXPECT_NEAR(added[1] / added[0], 2, 1e-3);
}

// A thousand a turn come and as many go: the pool stays as it is, and what is uploaded is theirs alone.
TEST(PointPool, RowsAndPointsAreUsedAgain) {
    Pool p("crowd", 2000);
    const auto first = uint32_t(p.scene.instances.size());
    const RenderInstance model = p.scene.instances.back();
    size_t size = 0;
    for (uint32_t turn = 0; turn < 8; ++turn) {
        p.clearChanges();
        std::vector<RenderScene::Range> rows;
        for (uint32_t i = 0; i < 1000; ++i) {
            const uint32_t row = first + 2 * i + turn % 2, gone = first + 2 * i + 1 - turn % 2;
            p.scene.instances.resize(first + 2000, {.primitive = kNoPrimitive});
            p.scene.instances[row] = model;
            p.scene.instances[row].skinnedMesh = kNoSkinnedMesh;
            p.scene.instances[row].movable = true;
            p.scene.instances[gone] = {.primitive = kNoPrimitive};
        }
        const RenderScene::Range all{0, first + 2000};
        ASSERT_TRUE(p.points.follow(p.scene, std::span(&all, 1)));
        if (turn == 1) size = p.points.samples().size();
        if (turn > 1) {
            EXPECT_EQ(p.points.samples().size(), size);
            EXPECT_LE(countOf(p.points.changedSamples), 1000u * 2 * 32);
        }
        EXPECT_EQ(p.areas().size(), first + 1000);
    }
}

TEST(PointPool, WhatJointsBendAndMuchMoreSurfaceAreChosenAnew) {
    Pool p("crowd", 40);
    RenderInstance bent = p.scene.instances.back();
    bent.skinnedMesh = 0;
    EXPECT_FALSE(p.replace(uint32_t(p.scene.instances.size()), bent));
    Pool grown("cornell", 0);
    RenderInstance house = grown.scene.instances.front();
    house.worldFromLocal = glm::mat4x3(20);
    EXPECT_FALSE(grown.replace(uint32_t(grown.scene.instances.size()), house));
}

}  // namespace
}  // namespace ag::render
