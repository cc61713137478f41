// Points on surfaces: spread by area along a curve whose every n-th point is spread too, aware of where
// surfaces end and how they curve.
#include "engine/renderer/scene_surfaces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "engine/scene/static_scene.h"
#include "tools/scenegen/builder.h"
#include "tools/scenegen/scenes.h"

namespace ag::gi {
using namespace render;
namespace {

std::map<uint32_t, int> countByInstance(std::span<const io::SurfaceSample> samples) {
    std::map<uint32_t, int> counts;
    for (const io::SurfaceSample& s : samples)
        ++counts[s.instance];
    return counts;
}

std::vector<io::SurfaceSample> everyNth(const std::vector<io::SurfaceSample>& samples, size_t n,
                                        size_t first) {
    std::vector<io::SurfaceSample> out;
    for (size_t i = first; i < samples.size(); i += n)
        out.push_back(samples[i]);
    return out;
}

SceneAsset floorAndBox() {
    scenegen::SceneBuilder b("floor and box");
    const uint32_t gray = b.material("gray", glm::vec3(0.5f));
    b.quad("floor", {0, 0, 0}, {0, 0, 4}, {4, 0, 0}, gray);  // 16 m²
    b.box("box", {2, 0.5f, 2}, {1, 1, 1}, gray);             // 6 m²
    b.camera("camera", {0, 3, 4}, {0, 0, 0}, 50);
    return b.finish();
}

// A ball of quads along circles of latitude.
GeometryArrays sphereOf(float radius) {
    constexpr uint32_t kRings = 24, kSides = 48;
    GeometryArrays g;
    for (uint32_t ring = 0; ring <= kRings; ++ring)
        for (uint32_t side = 0; side <= kSides; ++side) {
            const float a = std::numbers::pi_v<float> * float(ring) / kRings;
            const float b = 2 * std::numbers::pi_v<float> * float(side) / kSides;
            const glm::vec3 n(std::sin(a) * std::cos(b), std::cos(a), std::sin(a) * std::sin(b));
            g.positions.push_back(radius * n);
            g.attributes.push_back({.normal = n});
        }
    for (uint32_t ring = 0; ring < kRings; ++ring)
        for (uint32_t side = 0; side < kSides; ++side) {
            const uint32_t i = ring * (kSides + 1) + side, below = i + kSides + 1;
            for (const uint32_t corner : {i, i + 1, below, below, i + 1, below + 1})
                g.indices.push_back(corner);
        }
    g.primitives.push_back({.indexCount = uint32_t(g.indices.size())});
    g.materials.resize(1);
    return g;
}

// The instance that has more triangles than the floor's two.
uint32_t boxOf(const RenderScene& scene) {
    return scene.geometry->primitives[scene.instances[1].primitive].indexCount > 6;
}

// m² that all points together stand for.
float areaOf(const SurfaceSamples& all) {
    double area = 0;
    for (const io::SurfaceSample& s : all.samples)
        area += double(all.pointAreas[s.instance]);
    return float(area);
}

TEST(SurfaceSampling, EqualAreasGetEqualCounts) {
    const SceneAsset asset = floorAndBox();
    const RenderScene scene = staticScene(asset);
    const SurfaceSamples all = render::sampleSurfaces(scene, 8192);
    EXPECT_NEAR(areaOf(all), 22, 1e-3);
    ASSERT_NEAR(double(all.samples.size()), 8192, 1);
    for (size_t first = 0; first < 8; ++first) {
        const auto counts = countByInstance(everyNth(all.samples, 8, first));
        ASSERT_EQ(counts.size(), 2u);
        const int a = counts.begin()->second, b = counts.rbegin()->second;
        EXPECT_NEAR(std::max(a, b) / double(a + b), 16.0 / 22, 0.01) << "from " << first;
    }
}

TEST(SurfaceSampling, EveryNthLeavesNoLargeHoles) {
    scenegen::SceneBuilder b("floor");
    b.quad("floor", {0, 0, 0}, {0, 0, 1}, {1, 0, 0}, b.material("gray", glm::vec3(0.5f)));
    b.camera("camera", {0, 3, 4}, {0, 0, 0}, 50);
    const SceneAsset asset = b.finish();
    const RenderScene scene = staticScene(asset);
    const SurfaceSamples all = render::sampleSurfaces(scene, 16384);
    // 1,024 points over 16 x 16 cells: 4 each; independent ones would leave 2 % of the cells empty.
    for (size_t first = 0; first < 16; ++first) {
        std::map<int, int> cells;
        for (const io::SurfaceSample& s : everyNth(all.samples, 16, first))
            ++cells[int(s.positionLocal.x * 16) * 16 + int(s.positionLocal.z * 16)];
        EXPECT_GE(cells.size(), 252u) << "from " << first;
    }
}

// What moves has segments of its own, behind those of what is static, and points by its share of the area.
TEST(SurfaceSampling, MovableInstancesHaveTheirOwnSegments) {
    const SceneAsset asset = floorAndBox();
    for (const uint32_t moving : {0u, 1u}) {
        RenderScene scene = staticScene(asset);
        scene.instances[moving].movable = true;
        const SurfaceSamples all = render::sampleSurfaces(scene, 8192);
        ASSERT_EQ(all.samples.size(), 8192u);
        EXPECT_EQ(all.staticCount % io::kSegmentPoints, 0u);
        EXPECT_NEAR(areaOf(all), 22, 1e-3);
        for (size_t i = 0; i < all.samples.size(); ++i)
            ASSERT_EQ(all.samples[i].instance == moving, i >= all.staticCount) << i;
        EXPECT_NEAR((moving ? 6 : 16) / 22.0, double(8192 - all.staticCount) / 8192, 0.01);
    }
    RenderScene scene = staticScene(asset);
    for (RenderInstance& instance : scene.instances)
        instance.movable = true;
    EXPECT_EQ(render::sampleSurfaces(scene, 8192).staticCount, 0u);
}

// A box of 6 m² beside a floor of 160,000 m² would get a point by its area alone.
TEST(SurfaceSampling, SmallThingsHavePointsThatStandForLess) {
    const SceneAsset asset = floorAndBox();
    RenderScene scene = staticScene(asset);
    const uint32_t box = boxOf(scene);
    scene.instances[1 - box].worldFromLocal = glm::mat4x3(glm::scale(glm::mat4(1), glm::vec3(100)));
    const SurfaceSamples all = render::sampleSurfaces(scene, 8192);
    auto counts = countByInstance(all.samples);
    EXPECT_NEAR(counts[box], 24, 2);
    EXPECT_NEAR(counts[box] * all.pointAreas[box], 6, 0.6);
    EXPECT_NEAR(areaOf(all), 160006, 200);
}

// A quarter of the points is for that, however many small things there are.
TEST(SurfaceSampling, LargeThingsKeepThreeQuartersOfThePoints) {
    const SceneAsset asset = floorAndBox();
    RenderScene scene = staticScene(asset);
    const uint32_t box = boxOf(scene), floor = 1 - box;
    scene.instances[floor].worldFromLocal = glm::mat4x3(glm::scale(glm::mat4(1), glm::vec3(1000)));
    const RenderInstance small = scene.instances[box];
    scene.instances.resize(1000, small);
    const SurfaceSamples all = render::sampleSurfaces(scene, 8192);
    const auto large = std::ranges::count(all.samples, floor, &io::SurfaceSample::instance);
    EXPECT_NEAR(double(large) / double(all.samples.size()), 0.8, 0.03);
}

TEST(SurfaceSampling, CutOutPointsStandForNothing) {
    SceneAsset asset = floorAndBox();
    GeometryArrays& g = asset.geometry;
    // The left half of the texture is cut out; over the floor u runs with x.
    Material& m = g.materials[0];
    m.alphaMode = AlphaMode::kMask;
    m.textureClass = TextureClass::k256;
    m.baseColorLayer = 0;
    auto& texels = g.textures[size_t(TextureClass::k256)].srgb.emplace_back(256 * 256 * 4, uint8_t(255));
    for (size_t i = 0; i < 256 * 256; ++i)
        texels[i * 4 + 3] = i % 256 < 128 ? 0 : 255;
    for (size_t i = 0; i < g.positions.size(); ++i)
        g.attributes[i].uv = {g.positions[i].x / 4, 0.5f};
    const RenderScene scene = staticScene(asset);
    int out = 0, in = 0;
    for (const io::SurfaceSample& s : render::sampleSurfaces(scene, 4096).samples) {
        if (std::abs(s.positionLocal.y) > 1e-6f || std::abs(s.normalLocal.y) < 0.9f) continue;  // the floor's
        const bool cut = s.edgesLocal[0].distance < 0;
        EXPECT_EQ(cut, s.positionLocal.x < 2) << s.positionLocal.x;
        ++(cut ? out : in);
    }
    EXPECT_NEAR(out, in, 0.02 * (out + in));
    EXPECT_GT(in, 1000);
}

TEST(SurfaceSampling, SegmentsOfTheCurveAreCompact) {
    const SceneAsset asset = *scenegen::buildScene("cornell", 0);
    const RenderScene scene = staticScene(asset);
    const SurfaceSamples all = render::sampleSurfaces(scene, 1 << 14);
    const float side = std::sqrt(areaOf(all) / float(all.samples.size()));
    double sum = 0;
    const size_t segments = all.samples.size() / io::kSegmentPoints;
    for (size_t s = 0; s < segments; ++s) {
        Bounds box{glm::vec3(1e30f), glm::vec3(-1e30f)};
        for (size_t i = s * io::kSegmentPoints; i < (s + 1) * io::kSegmentPoints; ++i) {
            const glm::vec3 p = scene.instances[all.samples[i].instance].worldFromLocal *
                                glm::vec4(all.samples[i].positionLocal, 1);
            box = {glm::min(box.min, p), glm::max(box.max, p)};
        }
        sum += double(glm::distance(box.min, box.max)) / 2;
    }
    // A square of 64 points has half a diagonal of 5.7 of their distances; the curve jumps here and there.
    EXPECT_LT(sum / double(segments), 12 * double(side));
}

TEST(SurfaceSampling, CurvatureIsASpheresAndNoneOfABox) {
    const auto curvatures = [](const RenderScene& scene) {
        std::vector<float> all;
        for (const io::SurfaceSample& s : render::sampleSurfaces(scene, 1000).samples)
            all.push_back(s.curvatureLocal);
        std::ranges::sort(all);
        return all;
    };
    const SceneAsset flat = floorAndBox();
    EXPECT_EQ(curvatures(staticScene(flat)).back(), 0);
    const GeometryArrays sphere = sphereOf(0.5f);
    RenderScene scene{.geometry = &sphere};
    scene.instances.resize(1);
    scene.bounds = {glm::vec3(-0.5f), glm::vec3(0.5f)};
    const auto ball = curvatures(scene);
    EXPECT_NEAR(ball[ball.size() / 2], 2, 0.1) << "1/m on a sphere of 0.5 m";
}

TEST(SurfaceSampling, EdgesBoundTheSurfaceAndFlatSeamsDoNot) {
    const SceneAsset asset = floorAndBox();
    const RenderScene scene = staticScene(asset);
    int nearDiagonal = 0;
    for (const io::SurfaceSample& s : render::sampleSurfaces(scene, 4096).samples) {
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
    const SurfaceSamples a = render::sampleSurfaces(scene, 1000), b = render::sampleSurfaces(scene, 1000);
    ASSERT_EQ(a.samples.size(), b.samples.size());
    for (size_t i = 0; i < a.samples.size(); ++i)
        EXPECT_EQ(a.samples[i].positionLocal, b.samples[i].positionLocal);
    EXPECT_TRUE(render::sampleSurfaces(RenderScene{.geometry = scene.geometry}, 1000).samples.empty());
}

}  // namespace
}  // namespace ag::gi
