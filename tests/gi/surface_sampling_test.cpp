// Points on surfaces: spread by area, in an order whose runs are spread too, and aware of where surfaces end.
#include "gi/surface_sampling.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "engine/scene/static_scene.h"
#include "tools/scenegen/builder.h"
#include "tools/scenegen/scenes.h"

namespace ag::gi {
namespace {

std::map<uint32_t, int> countByInstance(std::span<const io::SurfaceSample> samples) {
    std::map<uint32_t, int> counts;
    for (const io::SurfaceSample& s : samples)
        ++counts[s.instance];
    return counts;
}

SceneAsset floorAndBox() {
    scenegen::SceneBuilder b("floor and box");
    const uint32_t gray = b.material("gray", glm::vec3(0.5f));
    b.quad("floor", {0, 0, 0}, {0, 0, 4}, {4, 0, 0}, gray);  // 16 m²
    b.box("box", {2, 0.5f, 2}, {1, 1, 1}, gray);             // 6 m²
    b.camera("camera", {0, 3, 4}, {0, 0, 0}, 50);
    return b.finish();
}

TEST(SurfaceSampling, EqualAreasGetEqualCountsInEveryRun) {
    const SceneAsset asset = floorAndBox();
    const RenderScene scene = staticScene(asset);
    const SurfaceSamples all = sampleSurfaces(scene, 8192);
    EXPECT_NEAR(all.area, 22, 1e-4);
    ASSERT_NEAR(double(all.samples.size()), 8192, 1);
    for (size_t first = 0; first + 1024 <= all.samples.size(); first += 1024) {
        const auto counts = countByInstance(std::span(all.samples).subspan(first, 1024));
        ASSERT_EQ(counts.size(), 2u);
        EXPECT_NEAR(counts.begin()->second + counts.rbegin()->second, 1024, 0);
        const int most = std::max(counts.begin()->second, counts.rbegin()->second);
        EXPECT_NEAR(most / 1024.0, 16.0 / 22, 0.01) << "run from " << first;
    }
}

TEST(SurfaceSampling, RunsLeaveNoLargeHoles) {
    scenegen::SceneBuilder b("floor");
    b.quad("floor", {0, 0, 0}, {0, 0, 1}, {1, 0, 0}, b.material("gray", glm::vec3(0.5f)));
    b.camera("camera", {0, 3, 4}, {0, 0, 0}, 50);
    const SceneAsset asset = b.finish();
    const RenderScene scene = staticScene(asset);
    const SurfaceSamples all = sampleSurfaces(scene, 16384);
    // 1,024 points over 16 x 16 cells: 4 each; independent ones would leave 2 % of the cells empty.
    for (size_t first = 0; first + 1024 <= all.samples.size(); first += 1024) {
        std::map<int, int> cells;
        for (size_t i = first; i < first + 1024; ++i) {
            const glm::vec3 p = all.samples[i].positionLocal;
            ++cells[int(p.x * 16) * 16 + int(p.z * 16)];
        }
        EXPECT_GE(cells.size(), 252u) << "run from " << first;
    }
}

TEST(SurfaceSampling, EdgesBoundTheSurfaceAndFlatSeamsDoNot) {
    const SceneAsset asset = floorAndBox();
    const RenderScene scene = staticScene(asset);
    int nearDiagonal = 0;
    for (const io::SurfaceSample& s : sampleSurfaces(scene, 4096).samples) {
        const bool onFloor = std::abs(s.positionLocal.y) < 1e-6f && std::abs(s.normalLocal.y) > 0.9f;
        if (!onFloor) continue;
        for (const io::SurfaceEdge& edge : s.edgesLocal) {
            ASSERT_LT(edge.distance, 1e9f) << "each half of the floor has two outer sides";
            ASSERT_GE(edge.distance, 0);
            // Stepping outward by the distance ends on the floor's border.
            const glm::vec3 end = s.positionLocal - edge.inward * edge.distance;
            const float toBorder = std::min(std::min(std::abs(end.x), std::abs(4 - end.x)),
                                            std::min(std::abs(end.z), std::abs(4 - end.z)));
            EXPECT_LT(toBorder, 1e-4f);
        }
        nearDiagonal += std::abs(s.positionLocal.x - s.positionLocal.z) < 0.1f ||
                        std::abs(s.positionLocal.x + s.positionLocal.z - 4) < 0.1f;
    }
    EXPECT_GT(nearDiagonal, 0);
}

TEST(SurfaceSampling, SameSceneSamePoints) {
    const SceneAsset asset = *scenegen::buildScene("cornell", 0);
    const RenderScene scene = staticScene(asset);
    const SurfaceSamples a = sampleSurfaces(scene, 1000), b = sampleSurfaces(scene, 1000);
    ASSERT_EQ(a.samples.size(), b.samples.size());
    for (size_t i = 0; i < a.samples.size(); ++i)
        EXPECT_EQ(a.samples[i].positionLocal, b.samples[i].positionLocal);
    EXPECT_TRUE(sampleSurfaces(RenderScene{.geometry = scene.geometry}, 1000).samples.empty());
}

}  // namespace
}  // namespace ag::gi
