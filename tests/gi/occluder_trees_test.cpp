// Rays through the packed trees, as shaders/bvh/trace.glsl walks them, against every triangle by itself.
#include "gi/occluder_trees.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "engine/renderer/scene_surfaces.h"
#include "engine/scene/static_scene.h"
#include "tools/scenegen/builder.h"
#include "tools/scenegen/scenes.h"

namespace ag::gi {
namespace {

struct Ray {
    glm::vec3 origin, direction;
};

// The place along the ray, or `reach`.
float meet(const Ray& r, const std::array<glm::vec3, 3>& corners, float reach) {
    const glm::vec3 e1 = corners[1] - corners[0], e2 = corners[2] - corners[0];
    const glm::vec3 p = glm::cross(r.direction, e2), s = r.origin - corners[0], q = glm::cross(s, e1);
    const float det = glm::dot(e1, p);
    if (det == 0) return reach;
    const float u = glm::dot(s, p) / det, v = glm::dot(r.direction, q) / det, t = glm::dot(e2, q) / det;
    return u >= 0 && v >= 0 && u + v <= 1 && t > 0 ? std::min(t, reach) : reach;
}

struct Walked {
    OccluderTrees trees;
    MoverTree movers;

    bool meetsBox(const Ray& r, glm::uvec4 node, float reach) const {
        const glm::vec3 low(node.x & 0xffff, node.x >> 16, node.y & 0xffff),
            high(node.y >> 16, node.z & 0xffff, node.z >> 16);
        const glm::vec3 a = (low - r.origin) / r.direction, b = (high - r.origin) / r.direction;
        const glm::vec3 enter = glm::min(a, b), leave = glm::max(a, b);
        return std::max({enter.x, enter.y, enter.z, 0.0f}) <= std::min({leave.x, leave.y, leave.z, reach});
    }
    void walk(const std::vector<glm::uvec4>& nodes, uint32_t place, const Ray& world, float& reach,
              auto&& visit) const {
        const io::BvhPlace& p = movers.places[place];
        const glm::mat4 grid = glm::transpose(
            glm::mat4(p.gridFromWorld0, p.gridFromWorld1, p.gridFromWorld2, glm::vec4(0, 0, 0, 1)));
        const Ray r{glm::vec3(grid * glm::vec4(world.origin, 1)), glm::mat3(grid) * world.direction};
        for (uint32_t n = p.firstNode; n < p.endNode;) {
            const bool leaf = nodes[n].w >= io::kBvhLeafBit, met = meetsBox(r, nodes[n], reach);
            if (leaf && met)
                for (uint32_t i = 0; i < (nodes[n].w >> io::kBvhCountShift & io::kBvhMostLeafItems); ++i)
                    visit((nodes[n].w & (io::kBvhMostItems - 1)) + i, r);
            n = leaf || met ? n + 1 : nodes[n].w;
        }
    }
    void trace(uint32_t place, const Ray& ray, float& reach) const {
        walk(trees.nodes, place, ray, reach, [&](uint32_t triangle, const Ray& r) {
            const io::BvhTriangle& t = trees.triangles[triangle];
            reach = meet(r, {t.corner, t.corner + t.edge1, t.corner + t.edge2}, reach);
        });
    }
    float first(const Ray& ray, float reach) const {
        trace(io::kBvhStatic, ray, reach);
        walk(movers.nodes, io::kBvhMovers, ray, reach,
             [&](uint32_t item, const Ray&) { trace(io::kBvhFirstMover + item, ray, reach); });
        return reach;
    }
};

float firstOfAll(const RenderScene& scene, const Ray& ray, float reach) {
    const GeometryArrays& g = *scene.geometry;
    for (const RenderInstance& instance : scene.instances) {
        const Primitive& p = g.primitives[instance.primitive];
        for (uint32_t i = p.firstIndex; i < p.firstIndex + p.indexCount; i += 3) {
            std::array<glm::vec3, 3> corners;
            for (uint32_t k = 0; k < 3; ++k)
                corners[k] = instance.worldFromLocal *
                             glm::vec4(g.positions[g.indices[i + k] + uint32_t(p.vertexOffset)], 1);
            reach = meet(ray, corners, reach);
        }
    }
    return reach;
}

// Rays of the scene's size; how many find the same place to within a ten thousandth of it.
void expectSameHits(const RenderScene& scene) {
    Walked walked{.trees = render::buildTrees(scene)};
    std::vector<SampledInstance> moving;
    render::placeTrees(scene, walked.trees, true, moving, walked.movers);
    std::mt19937 random(7);
    std::normal_distribution<float> normal;
    std::uniform_real_distribution<float> unit;
    const glm::vec3 size = scene.bounds.max - scene.bounds.min;
    const float extent = glm::length(size);
    int hits = 0, differ = 0;
    for (int i = 0; i < 3000; ++i) {
        const glm::vec3 from = scene.bounds.min + size * glm::vec3(unit(random), unit(random), unit(random));
        const Ray ray{from, glm::normalize(glm::vec3(normal(random), normal(random), normal(random)))};
        const float truth = firstOfAll(scene, ray, extent), found = walked.first(ray, extent);
        hits += truth < extent;
        differ += std::abs(truth - found) > 1e-4f * extent;
    }
    EXPECT_GT(hits, 500);
    EXPECT_LE(differ, 3);  // along an edge rounding decides
}

TEST(OccluderTrees, RaysMeetWhatTheyMeetWithoutTrees) {
    const SceneAsset asset = *scenegen::buildScene("occluder", 0);
    RenderScene scene = staticScene(asset);
    expectSameHits(scene);
    // As movable things, turned, stretched and mirrored.
    for (size_t i = 0; i < scene.instances.size(); ++i) {
        RenderInstance& instance = scene.instances[i];
        instance.movable = i % 2 == 0;
        if (!instance.movable) continue;
        const glm::mat4 turn = glm::rotate(glm::mat4(1), 0.3f * float(i), glm::vec3(0, 1, 0));
        const glm::mat4 stretch = glm::scale(glm::mat4(1), glm::vec3(i % 4 == 0 ? -1 : 1, 1.5f, 0.7f));
        instance.worldFromLocal = glm::mat4x3(glm::mat4(instance.worldFromLocal) * turn * stretch);
    }
    expectSameHits(scene);
}

// Area times reflectance, and the volume that fronts look out of; both in the grid's units.
struct TreeSums {
    glm::dvec3 reflected{0};
    double area = 0, volume = 0;
};

TreeSums sumsOf(std::span<const io::BvhTriangle> triangles) {
    TreeSums sums;
    for (const io::BvhTriangle& t : triangles) {
        const glm::dvec3 across = 0.5 * glm::dvec3(glm::cross(t.edge1, t.edge2));
        const glm::dvec3 middle = glm::dvec3(t.corner) + glm::dvec3(t.edge1 + t.edge2) / 3.0;
        sums.area += glm::length(across);
        sums.reflected += glm::length(across) * glm::dvec3(io::reflectanceOf(t.reflects));
        sums.volume += double(io::frontOf(t.reflects, t.shines)) * glm::dot(across, middle) / 3;
    }
    return sums;
}

// Two boxes, one a mirror image of the other: what they reflect is their materials', and their fronts look
// outwards.
TEST(OccluderTrees, TrianglesKnowWhatTheyReflectAndToWhichSide) {
    scenegen::SceneBuilder builder("boxes");
    const glm::vec3 red(0.6f, 0.1f, 0.05f), dark(0.02f);
    builder.box("red", {-2, 0, 0}, glm::vec3(1), builder.material("red", red));
    builder.box("dark", {2, 0, 0}, glm::vec3(1), builder.material("dark", dark));
    builder.camera("camera", {0, 0, 5}, {0, 0, 0}, 60);
    const SceneAsset asset = builder.finish();
    RenderScene scene = staticScene(asset);
    scene.instances[0].worldFromLocal[0] = -scene.instances[0].worldFromLocal[0];
    for (const bool movable : {false, true}) {
        for (RenderInstance& instance : scene.instances)
            instance.movable = movable;
        const OccluderTrees trees = render::buildTrees(scene);
        const TreeSums sums = sumsOf(trees.triangles);
        const glm::dvec3 mean = sums.reflected / sums.area, truth = 0.5 * glm::dvec3(red + dark);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(mean[c], truth[c], 0.02 * truth[c]) << movable;
        // Of cubes: a sixth of the area times the side.
        const double side = std::sqrt(sums.area / double(trees.triangles.size()) * 2);
        EXPECT_NEAR(sums.volume / (sums.area / 6 * side), 1, 1e-3) << movable;
    }
}

TEST(OccluderTrees, TrianglesThatShineKnowTheirRadiance) {
    for (const glm::vec3 radiance : {glm::vec3(20, 7, 0.5f), glm::vec3(3e-4f, 0, 1e-4f), glm::vec3(64)}) {
        scenegen::SceneBuilder builder("sign");
        const uint32_t glow = builder.emissive("glow", glm::vec3(0.5f), radiance);
        builder.quad("square", {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, glow);
        builder.camera("camera", {0, 0, 5}, {0, 0, 0}, 60);
        const SceneAsset asset = builder.finish();
        const OccluderTrees trees = render::buildTrees(staticScene(asset));
        ASSERT_EQ(trees.triangles.size(), 2u);
        for (const io::BvhTriangle& t : trees.triangles) {
            EXPECT_EQ(io::frontOf(t.reflects, t.shines), 1);
            EXPECT_LT(glm::distance(io::reflectanceOf(t.reflects), glm::vec3(0.5f)), 0.01f);
            const glm::vec3 stored = io::radianceOf(t.shines);
            const float most = std::max({radiance.x, radiance.y, radiance.z});
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(stored[c], radiance[c], most / 63);
        }
    }
}

TEST(OccluderTrees, NothingIsNoTree) {
    const SceneAsset asset = *scenegen::buildScene("occluder", 0);
    RenderScene scene = staticScene(asset);
    scene.instances.clear();
    const OccluderTrees trees = render::buildTrees(scene);
    EXPECT_TRUE(trees.everythingStatic.empty());
    MoverTree movers;
    std::vector<SampledInstance> moving;
    render::placeTrees(scene, trees, true, moving, movers);
    ASSERT_EQ(movers.places.size(), io::kBvhFirstMover);
    EXPECT_EQ(movers.places[io::kBvhStatic].endNode, 0u);
}

// What is new at once, what moves not before it has rested.
TEST(TreeUpkeep, BuildsWhatHasRested) {
    using enum TreeUpkeep::Task;
    TreeUpkeep upkeep;
    EXPECT_EQ(upkeep.next(7), kBuild);
    EXPECT_EQ(upkeep.next(7), kUse);
    for (uint64_t version = 8; version < 60; ++version)
        EXPECT_EQ(upkeep.next(version), kNone) << "it moves each frame";
    int frames = 1;
    while (upkeep.next(59) == kNone)
        ++frames;
    EXPECT_EQ(frames, 16);
    EXPECT_EQ(upkeep.next(59), kUse);
    EXPECT_EQ(upkeep.next(60), kNone);
    EXPECT_EQ(upkeep.next(59), kUse) << "it went back";
    upkeep.forget();
    EXPECT_EQ(upkeep.next(60), kBuild);
}

// In a grid's coordinates places are where the tree's own coordinates say, whatever those of the rays.
TEST(OccluderTrees, ArePlacedInOtherUnitsAndAboutOtherOrigins) {
    const SceneAsset asset = *scenegen::buildScene("occluder", 0);
    const OccluderTrees trees = render::buildTrees(staticScene(asset));
    const float units = 0.25f;
    const glm::vec3 origin(3, -2, 5), place(0.3f, 1.1f, -0.4f);
    glm::mat4x3 treeFromOurs(units);
    treeFromOurs[3] = origin;
    const io::BvhPlace own = placeOf(trees.everythingStatic, glm::mat4x3(1)),
                       other = placeOf(trees.everythingStatic, treeFromOurs);
    const auto inGrid = [](const io::BvhPlace& p, glm::vec3 x) {
        const glm::vec4 at(x, 1);
        return glm::vec3(glm::dot(p.gridFromWorld0, at), glm::dot(p.gridFromWorld1, at),
                         glm::dot(p.gridFromWorld2, at));
    };
    const glm::vec3 a = inGrid(own, place), b = inGrid(other, (place - origin) / units);
    EXPECT_LT(glm::length(a - b), 0.02f) << "of 65,535 steps";
    EXPECT_GT(glm::length(a), 100.0f);
    EXPECT_EQ(own.endNode, other.endNode);
}

}  // namespace
}  // namespace ag::gi
