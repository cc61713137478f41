// Large primitives in pieces: the same triangles, each piece small and in a place of its own.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "engine/scene/split_primitives.h"

namespace ag {
namespace {

using Corners = std::array<float, 9>;

std::vector<Corners> trianglesOf(const GeometryArrays& g, const Primitive& p) {
    std::vector<Corners> out;
    for (uint32_t i = 0; i < p.indexCount; i += 3) {
        Corners c{};
        for (uint32_t k = 0; k < 3; ++k) {
            const glm::vec3 at =
                g.positions[size_t(int64_t(g.indices[p.firstIndex + i + k]) + p.vertexOffset)];
            for (int axis = 0; axis < 3; ++axis)
                c[3 * k + size_t(axis)] = at[axis];
            EXPECT_TRUE(glm::all(glm::greaterThanEqual(at, p.boundsLocal.min)));
            EXPECT_TRUE(glm::all(glm::lessThanEqual(at, p.boundsLocal.max)));
        }
        out.push_back(c);
    }
    return out;
}

std::vector<Corners> allTriangles(const SceneAsset& asset) {
    std::vector<Corners> out;
    for (const SceneMesh& mesh : asset.meshes)
        for (uint32_t i = 0; i < mesh.primitiveCount; ++i)
            for (const Corners& c :
                 trianglesOf(asset.geometry, asset.geometry.primitives[mesh.firstPrimitive + i]))
                out.push_back(c);
    std::ranges::sort(out);
    return out;
}

TEST(SplitPrimitives, KeepsTheTrianglesInSmallPieces) {
    constexpr uint32_t kSide = 40;
    SceneAsset asset;
    GeometryArrays& g = asset.geometry;
    for (uint32_t i = 0; i < (kSide + 1) * (kSide + 1); ++i)
        g.positions.push_back({float(i % (kSide + 1)), 0, float(i / (kSide + 1))});
    for (uint32_t i = 0; i < kSide * kSide; ++i) {
        const uint32_t corner = i / kSide * (kSide + 1) + i % kSide;
        for (const uint32_t step : {0u, kSide + 1, 1u, 1u, kSide + 1, kSide + 2})
            g.indices.push_back(corner + step);
    }
    g.primitives.push_back({.indexCount = uint32_t(g.indices.size()), .material = 1});
    g.indices.insert(g.indices.end(), {0, kSide + 1, 1, 1, kSide + 1, kSide + 2});
    g.primitives.push_back(
        {.firstIndex = kSide * kSide * 6, .indexCount = 6, .material = 2});  // stays as it is
    for (Primitive& p : g.primitives)
        p.boundsLocal = {glm::vec3(0), glm::vec3(kSide, 0, kSide)};
    asset.meshes.push_back({"field", 0, 1});
    asset.meshes.push_back({"tile", 1, 1});
    const std::vector<Corners> before = allTriangles(asset);
    ASSERT_EQ(before.size(), 3202u);
    splitLargePrimitives(asset, 100);
    EXPECT_EQ(allTriangles(asset), before);
    ASSERT_EQ(g.primitives.size(), 33u);
    EXPECT_EQ(asset.meshes[0].primitiveCount, 32u) << "halved five times";
    EXPECT_EQ(asset.meshes[1].firstPrimitive, 32u);
    EXPECT_EQ(asset.meshes[1].primitiveCount, 1u);
    float area = 0;
    for (uint32_t i = 0; i < 32; ++i) {
        const Primitive& p = g.primitives[i];
        EXPECT_EQ(p.material, 1u);
        EXPECT_LE(p.indexCount, 300u);
        const glm::vec3 size = p.boundsLocal.max - p.boundsLocal.min;
        area += size.x * size.z;
    }
    EXPECT_LT(area, 1.5f * 1600) << "pieces hardly overlap";
}

}  // namespace
}  // namespace ag
