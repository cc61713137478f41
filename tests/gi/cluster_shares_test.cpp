// How lights share the clusters, by flux, all of them, and steadily; and the texels.
#include <gtest/gtest.h>

#include "gi/rsm_views.h"

namespace ag::gi {
namespace {

struct Lit {
    std::vector<RsmLight> lights;
    operator World() const { return {.lights = lights, .bounds = {glm::vec3(-2), glm::vec3(2)}}; }
};

Lit threeLights() {
    Lit scene;
    for (uint64_t id = 1; id <= 3; ++id)
        scene.lights.push_back({.kind = LightKind::kSpot, .intensity = glm::vec3(10 * float(id)), .id = id});
    return scene;
}

struct Range {
    uint32_t first, count;
    bool operator==(const Range&) const = default;
};

Range rangeOf(const RsmLayout& layout, uint64_t id) {
    for (uint32_t m = 0; m < layout.mapCount; ++m)
        if (layout.maps[m].id == id) return {layout.maps[m].firstCluster, layout.maps[m].clusterCount};
    return {0, 0};
}

TEST(ClusterShares, AreByFluxAndTogetherAllThereAre) {
    for (const uint32_t budget : {3u, 16u, 23u, 40u, 64u, 100u, 128u, 1024u}) {
        Lit scene = threeLights();
        RsmHistory history;
        const RsmLayout layout = layoutRsm(scene, {}, budget, history);
        uint32_t next = 0;
        for (uint64_t id = 1; id <= 3; ++id) {
            const Range range = rangeOf(layout, id);
            EXPECT_EQ(range.first, next) << "no two have the same";
            EXPECT_GE(range.count, 1u);
            if (budget >= 24) {
                EXPECT_NEAR(range.count, std::max(float(budget * id) / 6, 8.0f), 8) << "of " << budget;
            }
            next = range.first + range.count;
        }
        EXPECT_EQ(next, budget);
    }
}

TEST(ClusterShares, ALightThatFlickersTakesNothingFromTheOthers) {
    Lit scene = threeLights();
    RsmHistory history;
    const RsmLayout before = layoutRsm(scene, {}, 128, history);
    for (int frame = 0; frame < 100; ++frame) {
        const float flame = frame % 7 == 0 ? 0 : frame % 2 ? 0.75f : 1.3f;  // it goes out now and then
        scene.lights[1].intensity = glm::vec3(20 * flame);
        const RsmLayout now = layoutRsm(scene, {}, 128, history);
        EXPECT_EQ(now.mapCount, flame == 0 ? 2u : 3u);
        for (const uint64_t id : {1, 3})
            EXPECT_EQ(rangeOf(now, id), rangeOf(before, id)) << "frame " << frame;
        if (flame > 0) {
            EXPECT_EQ(rangeOf(now, 2), rangeOf(before, 2));
        }
    }
}

TEST(ClusterShares, FollowLightThatStaysChanged) {
    Lit scene = threeLights();
    RsmHistory history;
    const uint32_t before = rangeOf(layoutRsm(scene, {}, 128, history), 1).count;
    scene.lights[0].intensity *= 9.0f;
    RsmHistory fresh;
    const RsmLayout brighter = layoutRsm(scene, {}, 128, history);
    EXPECT_GT(rangeOf(brighter, 1).count, 2 * before);
    EXPECT_EQ(rangeOf(brighter, 1), rangeOf(layoutRsm(scene, {}, 128, fresh), 1));
}

TEST(ClusterShares, OfALightThatStaysDarkGoToTheOthers) {
    Lit scene = threeLights();
    RsmHistory history;
    layoutRsm(scene, {}, 128, history);
    scene.lights[2].intensity = glm::vec3(0);
    uint32_t frames = 0, all = 0;
    for (; all < 128 && frames < 1000; ++frames) {
        const RsmLayout now = layoutRsm(scene, {}, 128, history);
        all = rangeOf(now, 1).count + rangeOf(now, 2).count;
    }
    EXPECT_GT(frames, 60u);
    EXPECT_EQ(all, 128u);
    EXPECT_EQ(history.shares.count, 2u);
    scene.lights[0].intensity = scene.lights[1].intensity = glm::vec3(0);
    EXPECT_EQ(layoutRsm(scene, {}, 128, history).mapCount, 0u) << "no light, no map";
}

uint64_t texelsOf(const RsmLayout& layout) {
    uint64_t texels = 0;
    for (uint32_t f = 0; f < layout.faceCount; ++f)
        texels += uint64_t(layout.faces[f].size) * layout.faces[f].size;
    return texels;
}

TEST(RsmSizes, AreWhatLightsAskForAsLongAsTheyAreFew) {
    Lit scene = threeLights();
    RsmHistory history;
    EXPECT_EQ(texelsOf(layoutRsm(scene, {}, 128, history)), 3u * 512 * 512);
    EXPECT_EQ(texelsOf(layoutRsm(scene, {.resolution = 64}, 128, history)), 3u * 64 * 64);
    scene.lights[0].kind = LightKind::kPoint;
    scene.lights[1].resolution = 300;
    EXPECT_EQ(texelsOf(layoutRsm(scene, {}, 128, history)), (6u + 1 + 4) * 256 * 256);
}

TEST(RsmSizes, OfManyLightsAreHalvedAndDarkOnesCount) {
    Lit scene = threeLights();
    for (uint64_t id = 4; id <= 8; ++id)
        scene.lights.push_back({.kind = LightKind::kPoint, .intensity = glm::vec3(1), .id = id});
    RsmHistory history;
    EXPECT_EQ(texelsOf(layoutRsm(scene, {.resolution = 1024}, 128, history)), (3u * 4 + 5 * 6) * 128 * 128);
    const RsmLayout all = layoutRsm(scene, {}, 128, history);
    EXPECT_EQ(all.faces[0].size, 256u);
    for (size_t i = 1; i < scene.lights.size(); ++i)
        scene.lights[i].intensity = glm::vec3(0);
    EXPECT_EQ(layoutRsm(scene, {}, 128, history).faces[0].size, 256u) << "no map grows as others go out";
}

}  // namespace
}  // namespace ag::gi
