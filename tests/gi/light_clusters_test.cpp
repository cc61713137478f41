// Clusters of punctual lights against the plain definition of both passes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "common/sampling.h"
#include "engine/renderer/light_clusters.h"
#include "engine/scene/static_scene.h"

namespace ag::gi {
using namespace render;
namespace {

RenderScene sceneWithLights(uint32_t count) {
    RenderScene scene;
    for (uint32_t i = 0; i < count; ++i)
        scene.lights.push_back({.kind = i % 5 == 4 ? LightKind::kSpot : LightKind::kPoint,
                                .position = {20 * io::hashToUnit(3 * i) - 10, 4 * io::hashToUnit(3 * i + 1),
                                             20 * io::hashToUnit(3 * i + 2) - 10},
                                .intensity = glm::vec3(0.5f + 2 * io::hashToUnit(7 * i)),
                                .range = 3,
                                .id = i + 1});
    setCamera(scene, {.position = {0, 2, 12}, .forward = {0, 0, -1}, .verticalFov = 1}, {160, 90});
    return scene;
}

LightClusterSettings published() {
    return {.growth = 0.2f, .most = 256, .strongFirst = false, .hysteresis = 1, .shareWithin = 0};
}

TEST(LightClusters, BothPassesAreWhatTheirDefinitionsSay) {
    const RenderScene scene = sceneWithLights(300);
    const LightClusterSettings s = published();
    LightClusterHistory history;
    const LightClusters& c = clusterLights(scene, {}, s, history);
    ASSERT_GT(c.clusters.size(), 5u);
    EXPECT_EQ(c.stretch, 1);
    // First pass: in order, each light that keeps its distance from all centres before it.
    std::vector<uint32_t> centers;
    for (const uint32_t light : c.lights) {
        const glm::vec3 p = scene.lights[light].position;
        const float apart = s.growth * glm::distance(p, scene.camera.position);
        bool alone = true;
        for (const uint32_t center : centers)
            alone = alone && glm::distance(scene.lights[center].position, p) >= apart;
        if (alone) centers.push_back(light);
    }
    ASSERT_EQ(centers.size(), c.clusters.size());
    for (size_t k = 0; k < centers.size(); ++k)
        EXPECT_EQ(c.clusters[k].center, centers[k]);
    // Second pass: the nearest centre.
    uint32_t lights = 0;
    for (size_t i = 0; i < c.lights.size(); ++i) {
        ASSERT_LT(c.clusterOf[i], c.clusters.size());
        const glm::vec3 p = scene.lights[c.lights[i]].position;
        const float mine = glm::distance(p, scene.lights[c.clusters[c.clusterOf[i]].center].position);
        for (const uint32_t center : centers)
            EXPECT_LE(mine, glm::distance(p, scene.lights[center].position));
        EXPECT_LE(mine, c.clusters[c.clusterOf[i]].radius);
    }
    for (const LightCluster& cluster : c.clusters)
        lights += cluster.lightCount;
    EXPECT_EQ(lights, c.lights.size());
}

TEST(LightClusters, LightsThatCannotReachTheViewAreLeftOut) {
    RenderScene scene = sceneWithLights(300);
    LightClusterHistory history;
    const LightClusters& c = clusterLights(scene, {}, published(), history);
    std::set<uint32_t> seen(c.lights.begin(), c.lights.end());
    EXPECT_LT(seen.size(), 300u);
    // Every light with a point of its sphere in the view is there: corners of the view at many distances.
    for (uint32_t i = 0; i < scene.lights.size(); ++i)
        for (uint32_t k = 0; k < 2000 && !seen.contains(i); ++k) {
            const glm::vec2 at = io::hammersley(k, 2000) * 2.0f - 1.0f;
            const float distance = 0.1f + 25 * io::hashToUnit(k);
            const float tanY = std::tan(0.5f), tanX = tanY * 16 / 9;
            const glm::vec3 p = scene.camera.position + distance * glm::vec3(at.x * tanX, at.y * tanY, -1);
            EXPECT_GT(glm::distance(p, scene.lights[i].position), scene.lights[i].range) << i;
        }
    for (RenderLight& light : scene.lights)
        light.position.z += 100;
    EXPECT_TRUE(clusterLights(scene, {}, published(), history).lights.empty());
    EXPECT_TRUE(history.clusters.clusters.empty());
}

TEST(LightClusters, TheBudgetIsKeptByStretchingDistances) {
    const RenderScene scene = sceneWithLights(1000);
    for (const uint32_t most : {1u, 4u, 10u, 26u, 100u}) {
        LightClusterHistory history;
        LightClusterSettings s = published();
        s.most = most;
        const LightClusters& c = clusterLights(scene, {}, s, history);
        EXPECT_LE(c.clusters.size(), most);
        EXPECT_GE(c.clusters.size(), most - most / 4) << "little of the budget is left";
        EXPECT_GE(c.stretch, 1);
    }
}

TEST(LightClusters, WithoutADistanceEachLightStandsForItself) {
    const RenderScene scene = sceneWithLights(100);
    LightClusterHistory history;
    const LightClusters& c = clusterLights(scene, {}, {.growth = 0, .most = 256, .hysteresis = 1}, history);
    EXPECT_EQ(c.clusters.size(), c.lights.size());
    for (const LightCluster& cluster : c.clusters) {
        EXPECT_EQ(cluster.lightCount, 1u);
        EXPECT_EQ(cluster.radius, 0);
    }
}

// Along a walk, how many centres are new from step to step.
int newCenters(const LightClusterSettings& settings) {
    RenderScene scene = sceneWithLights(300);
    LightClusterHistory history;
    std::vector<uint64_t> before;
    int fresh = 0;
    for (int step = 0; step < 120; ++step) {
        const float t = float(step) / 120;
        setCamera(scene, {.position = {8 * t - 4, 2, 12 - 4 * t}, .forward = {0, 0, -1}, .verticalFov = 1},
                  {160, 90});
        clusterLights(scene, {}, settings, history);
        for (const uint64_t id : history.centers)
            fresh += step > 0 && !std::ranges::binary_search(before, id);
        before = history.centers;
    }
    return fresh;
}

TEST(LightClusters, CentresKeepTheirRoleAlongAWalk) {
    LightClusterSettings with, without;
    without.hysteresis = 1;
    const int kept = newCenters(with), flipping = newCenters(without);
    std::printf("new centres in 120 steps: %d, without hysteresis %d\n", kept, flipping);
    EXPECT_LT(kept, flipping / 2);
}

// Where nothing changes nothing may: a budget, hysteresis and a second look must not shift centres.
TEST(LightClusters, NothingMovesNothingChanges) {
    RenderScene scene = sceneWithLights(300);
    for (const uint32_t most : {10u, 26u, 100u}) {
        LightClusterSettings s;
        s.most = most;
        LightClusterHistory history;
        const std::vector<uint32_t> first = clusterLights(scene, {}, s, history).clusterOf;
        for (int i = 0; i < 5; ++i)
            EXPECT_EQ(clusterLights(scene, {}, s, history).clusterOf, first);
        // A light that moves or a camera that turns is looked at again.
        const uint32_t seen = history.clusters.lights[0];
        const glm::vec3 before = scene.lights[seen].position;
        scene.lights[seen].position += glm::vec3(0, 100, 0);
        const LightClusters& moved = clusterLights(scene, {}, s, history);
        EXPECT_EQ(std::ranges::count(moved.lights, seen), 0);
        scene.lights[seen].position = before;
    }
}

TEST(LightClusters, LightsWithoutShadowHaveNoCluster) {
    RenderScene scene = sceneWithLights(50);
    for (RenderLight& light : scene.lights)
        light.castsShadow = light.id % 2 == 0;
    LightClusterHistory history;
    const LightClusters& c = clusterLights(scene, {}, {.shareWithin = 0}, history);
    for (size_t i = 0; i < c.lights.size(); ++i)
        EXPECT_EQ(c.clusterOf[i] == LightClusters::kNoCluster, !scene.lights[c.lights[i]].castsShadow);
    // Nor do those far from the centre they would share with, measured by their range.
    const LightClusters& few = clusterLights(scene, {}, {.most = 3, .shareWithin = 1}, history);
    for (size_t i = 0; i < few.lights.size(); ++i) {
        const RenderLight& light = scene.lights[few.lights[i]];
        float nearest = 1e30f;
        for (const LightCluster& cluster : few.clusters)
            nearest = std::min(nearest, glm::distance(scene.lights[cluster.center].position, light.position));
        EXPECT_EQ(few.clusterOf[i] != LightClusters::kNoCluster, light.castsShadow && nearest <= light.range);
    }
}

// Lights that light nothing seen get no map, however strong they are.
TEST(LightClusters, LightsThatMatterBecomeCentres) {
    RenderScene scene = sceneWithLights(60);
    std::vector<io::PunctualRelevance> rows;
    std::set<uint32_t> matter;
    for (uint32_t i = 0; i < scene.lights.size(); ++i) {
        const bool matters = i % 6 == 1;
        if (matters) matter.insert(i);
        scene.lights[i].range = 0;
        scene.lights[i].intensity = glm::vec3(matters ? 1 : 100);
        rows.push_back({.id = {uint32_t(scene.lights[i].id), 0}, .relevance = matters ? 5.0f : 1e-6f});
    }
    rows.push_back({.id = {7, 0}, .relevance = 0});  // no light
    PunctualRelevance relevance;
    relevance.set(std::as_bytes(std::span(rows)));
    EXPECT_NEAR(relevance.mean(), 5.0 / 6, 0.01);
    EXPECT_FALSE(relevance.of(1000).has_value());
    LightClusterHistory history;
    const LightClusters& c = clusterLights(scene, relevance, {.most = 6}, history);
    ASSERT_GE(c.clusters.size(), 4u);
    for (const LightCluster& cluster : c.clusters)
        EXPECT_TRUE(matter.contains(cluster.center)) << cluster.center;
}

TEST(LightClusters, AHundredThousandLightsAreLimitedToTheBrightest) {
    RenderScene scene = sceneWithLights(100'000);
    LightClusterHistory history;
    const LightClusters& c = clusterLights(scene, {}, {.shareWithin = 0}, history);
    EXPECT_EQ(c.lights.size(), kMostPunctualLights);
    EXPECT_GT(c.leftOut, 50'000u);
    EXPECT_LE(c.clusters.size(), LightClusterSettings{}.most);
    const auto brightness = [&](uint32_t i) {
        const float d = glm::distance(scene.lights[i].position, scene.camera.position);
        return scene.lights[i].intensity.x / std::max(d * d, 1.0f);
    };
    float least = 1e30f, mostLeftOut = 0;
    std::set<uint32_t> taken(c.lights.begin(), c.lights.end());
    for (uint32_t i = 0; i < scene.lights.size(); ++i) {
        const bool seen =
            sphereInView(scene.camera.clipFromWorld, scene.lights[i].position, scene.lights[i].range);
        if (taken.contains(i))
            least = std::min(least, brightness(i));
        else if (seen)
            mostLeftOut = std::max(mostLeftOut, brightness(i));
    }
    EXPECT_GE(least, mostLeftOut);
}

}  // namespace
}  // namespace ag::gi
