// What views draw: culled one by one or all at once as jobs, it is what a plain test of every box says.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <random>

#include "engine/renderer/draw_lists.h"
#include "engine/scene/static_scene.h"
#include "gi/light_views.h"
#include "tools/scenegen/scenes.h"

namespace ag::gi {
using namespace render;
namespace {

bool inSight(const RenderScene& scene, const RenderInstance& instance, const glm::mat4& m) {
    const Bounds& local = scene.geometry->primitives[instance.primitive].boundsLocal;
    glm::dvec3 low(1e30), high(-1e30);
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 p =
            glm::dmat4x3(instance.worldFromLocal) * glm::dvec4(corner & 1 ? local.max.x : local.min.x,
                                                               corner & 2 ? local.max.y : local.min.y,
                                                               corner & 4 ? local.max.z : local.min.z, 1);
        low = glm::min(low, p), high = glm::max(high, p);
    }
    const glm::dmat4 t = glm::transpose(glm::dmat4(m));
    for (const glm::dvec4& plane : {t[3] + t[0], t[3] - t[0], t[3] + t[1], t[3] - t[1], t[3] - t[2], t[2]}) {
        const glm::dvec3 nearest(plane.x > 0 ? high.x : low.x, plane.y > 0 ? high.y : low.y,
                                 plane.z > 0 ? high.z : low.z);
        if (glm::dot(glm::dvec3(plane), nearest) + plane.w < -1e-4 * glm::length(glm::dvec3(plane)))
            return false;
    }
    return true;
}

std::vector<uint32_t> rowsOf(const ViewDraws& draws, const BucketRange& range) {
    std::vector<uint32_t> rows;
    for (uint32_t c = 0; c < range.commandCount; ++c) {
        const VkDrawIndexedIndirectCommand& command = draws.commands[range.firstCommand + c];
        for (uint32_t k = 0; k < command.instanceCount; ++k)
            rows.push_back(draws.rows[command.firstInstance + k]);
    }
    return rows;
}

// A scene seen by its camera, and its lists.
struct Lists {
    SceneAsset asset;
    RenderScene scene = staticScene(asset);
    JobRunner one{1};
    DrawLists lists;

    Lists(const char* name, uint32_t param) : asset(*scenegen::buildScene(name, param)) {
        setCamera(scene, cameraOf(asset, 0), {160, 90});
    }
    const ViewDraws& seenByCamera() {
        lists.beginFrame(scene, one);
        return lists.cull(scene, 0, scene.camera.clipFromWorld);
    }
};

// What blends is the camera's alone: no list of what is opaque has it, and the other has nothing else.
TEST(DrawLists, BlendedSurfacesHaveAListOfTheirOwn) {
    Lists l("panes", 0);
    const GeometryArrays& g = l.asset.geometry;
    const auto blends = [&](uint32_t row) {
        return g.materials[g.primitives[l.scene.instances[row].primitive].material].alphaMode ==
               AlphaMode::kBlend;
    };
    const ViewDraws& opaque = l.seenByCamera();
    const ViewDraws& blended = l.lists.blendedOf(l.scene, 1, 0);
    EXPECT_TRUE(l.lists.hasBlended());
    EXPECT_TRUE(std::ranges::none_of(opaque.rows, blends));
    EXPECT_TRUE(std::ranges::all_of(blended.rows, blends));
    EXPECT_EQ(blended.rows.size(), 4u);
    EXPECT_FALSE(opaque.rows.empty());
    const uint64_t before = opaque.version;
    const uint32_t moved = blended.rows.front();
    l.scene.instances[moved].worldFromLocal[3].x += 0.1f;
    l.scene.changedInstances = {{moved, moved + 1}};
    l.scene.allInstancesChanged = false;
    ++l.scene.instancesVersion;
    EXPECT_EQ(l.seenByCamera().version, before) << "nothing that others draw has changed";
    Lists plain("cornell", 0);
    plain.seenByCamera();
    EXPECT_FALSE(plain.lists.hasBlended());
}

TEST(DrawLists, JobsCullWhatTheCallerCulls) {
    const SceneAsset asset = *scenegen::buildScene("crowd", 6000);
    RenderScene scene = staticScene(asset);
    setCamera(scene, cameraOf(asset, 0), {160, 90});
    std::vector<ViewRequest> views = {{0, scene.camera.clipFromWorld}};
    for (uint32_t face = 0; face < 6; ++face)
        views.push_back({1 + face, cubeFaceView({1, 2, 0}, face, 15).clipFromWorld});
    JobRunner one(1), four(4);
    DrawLists serial, jobs;
    std::mt19937 random(3);
    for (int turn = 0; turn < 4; ++turn) {
        serial.beginFrame(scene, one);
        jobs.beginFrame(scene, four);
        jobs.cullAll(scene, views);
        uint32_t drawn = 0;
        for (const ViewRequest& view : views) {
            const ViewDraws& a = serial.cull(scene, view.slot, view.clipFromWorld);
            const ViewDraws& b = jobs.cull(scene, view.slot, view.clipFromWorld);
            EXPECT_EQ(a.version, b.version);
            EXPECT_EQ(a.rows, b.rows);
            ASSERT_EQ(a.commands.size(), b.commands.size());
            EXPECT_EQ(
                std::memcmp(a.commands.data(), b.commands.data(), sizeof a.commands[0] * a.commands.size()),
                0);
            uint32_t expected = 0;
            for (const RenderInstance& instance : scene.instances)
                expected += inSight(scene, instance, view.clipFromWorld);
            EXPECT_NEAR(a.rows.size(), expected, 2) << "boxes that only touch";
            drawn += a.rows.size();
        }
        EXPECT_GT(drawn, 1000u);
        const uint32_t row = random() % uint32_t(scene.instances.size());
        scene.instances[row].worldFromLocal[3].y += 0.5f;
        scene.changedInstances = {{row, row + 1}};
        scene.allInstancesChanged = false;
        ++scene.instancesVersion;
    }
}

TEST(DrawLists, WhatIsTurnedOverIsDrawnFromABucketOfItsOwn) {
    Lists l("cornell", 0);
    RenderScene& scene = l.scene;
    for (int turn = 0; turn < 4; ++turn) {
        const ViewDraws& draws = l.seenByCamera();
        EXPECT_EQ(draws.rows.size(), scene.instances.size());
        for (size_t b = 0; b < draws.buckets.size(); ++b)
            for (const uint32_t row : rowsOf(draws, draws.buckets[b]))
                EXPECT_EQ(l.lists.buckets()[b].mirrored, row == 1 && turn % 2 == 1);
        scene.instances[1].worldFromLocal[0] *= -1.0f;
        scene.changedInstances = {{1, 2}};
        scene.allInstancesChanged = false;
        ++scene.instancesVersion;
    }
}

// Lists kept while things come, go and become others are those made anew; who does not see it keeps its
// version.
TEST(DrawLists, WhatComesAndGoesLeavesTheRestInPlace) {
    Lists l("crowd", 2000);
    RenderScene& scene = l.scene;
    const glm::mat4 aside = cubeFaceView({1, 2, 0}, 2, 15).clipFromWorld;  // looks up
    std::mt19937 random(5);
    l.seenByCamera();
    const uint64_t asideBefore = l.lists.cull(scene, 1, aside).version;
    scene.allInstancesChanged = false;
    for (int turn = 0; turn < 12; ++turn) {
        std::vector<uint32_t> rows;
        for (int i = 0; i < 40; ++i) {
            const uint32_t row = random() % uint32_t(scene.instances.size()), other = random() % 40;
            if (scene.instances[row].skinnedMesh != kNoSkinnedMesh) continue;
            RenderInstance& instance = scene.instances[row];
            if (instance.isPresent())
                instance = {.primitive = kNoPrimitive};
            else
                instance = {
                    .primitive = scene.instances[other].isPresent() ? scene.instances[other].primitive : 0,
                    .movable = bool(random() % 2)};
            rows.push_back(row);
        }
        std::ranges::sort(rows);
        scene.changedInstances.clear();
        for (const uint32_t row : rows)
            if (scene.changedInstances.empty() || scene.changedInstances.back().begin != row)
                scene.changedInstances.push_back({row, row + 1});
        ++scene.instancesVersion;
        const ViewDraws& kept = l.seenByCamera();
        DrawLists anew;
        anew.beginFrame(scene, l.one);
        const ViewDraws& made = anew.cull(scene, 0, scene.camera.clipFromWorld);
        std::vector<uint32_t> a = kept.rows, b = made.rows;
        std::ranges::sort(a), std::ranges::sort(b);
        EXPECT_EQ(a, b);
        for (size_t bucket = 0; bucket < kept.buckets.size(); ++bucket) {
            const auto same = std::ranges::find(anew.buckets(), l.lists.buckets()[bucket]);
            if (same == anew.buckets().end()) continue;
            EXPECT_EQ(rowsOf(kept, kept.buckets[bucket]),
                      rowsOf(made, made.buckets[size_t(same - anew.buckets().begin())]));
        }
        EXPECT_EQ(l.lists.cull(scene, 1, aside).version, asideBefore);
    }
}

// Every instance is drawn once, of its own primitive, what is static first; instances of a primitive are one
// draw.
// Ten times as far as the scene is wide, so that the grid is outgrown, too.
TEST(DrawLists, WhatMovesFarIsStillFound) {
    Lists l("crowd", 2000);
    RenderScene& scene = l.scene;
    for (RenderInstance& i : scene.instances)
        i.movable = i.movable || &i - scene.instances.data() > 100;
    l.seenByCamera();
    const glm::mat4 up = cubeFaceView({1, 2, 0}, 2, 15).clipFromWorld;
    l.lists.cull(scene, 1, up);
    const float wide = scene.bounds.max.x - scene.bounds.min.x;
    for (int frame = 0; frame < 540; ++frame) {
        const glm::vec3 step((frame < 270 ? 1.0f : -0.9f) * wide / 27, 0, 0);
        scene.bounds = {};
        for (RenderInstance& i : scene.instances) {
            if (i.movable) i.worldFromLocal[3] += step;
            const Bounds& local = scene.geometry->primitives[i.primitive].boundsLocal;
            for (const glm::vec3 corner : {local.min, local.max})
                scene.bounds.add(i.worldFromLocal * glm::vec4(corner, 1));
        }
        scene.changedInstances = {{0, uint32_t(scene.instances.size())}};
        scene.allInstancesChanged = false;
        ++scene.instancesVersion;
        l.lists.beginFrame(scene, l.one);
        if (frame % 90 != 89) continue;
        std::vector<uint32_t> seen = l.seenByCamera().rows, truth;
        const auto bent = [&](uint32_t i) { return scene.instances[i].skinnedMesh != kNoSkinnedMesh; };
        std::erase_if(seen, bent);  // their bounds are their pose's
        for (uint32_t i = 0; i < scene.instances.size(); ++i)
            if (!bent(i) && inSight(scene, scene.instances[i], scene.camera.clipFromWorld))
                truth.push_back(i);
        std::ranges::sort(seen);
        EXPECT_EQ(seen, truth) << frame;
    }
}

TEST(DrawLists, InstancesOfAPrimitiveAreOneDraw) {
    Lists l("crowd", 6000);
    RenderScene& scene = l.scene;
    for (size_t i = 0; i < scene.instances.size(); i += 3)
        scene.instances[i].movable = true;
    l.lists.beginFrame(scene, l.one);
    const ViewDraws& draws = l.lists.cull(scene, 0, sunView({0, -1, 0}, scene.bounds, 0.1f).clipFromWorld);
    std::vector<uint32_t> all;
    for (const BucketRange& range : draws.buckets)
        for (uint32_t c = 0; c < range.commandCount; ++c) {
            const VkDrawIndexedIndirectCommand& command = draws.commands[range.firstCommand + c];
            for (uint32_t k = 0; k < command.instanceCount; ++k) {
                const uint32_t row = all.emplace_back(draws.rows[command.firstInstance + k]);
                const Primitive& p = scene.geometry->primitives[scene.instances[row].primitive];
                ASSERT_EQ(command.firstIndex, p.firstIndex);
                ASSERT_EQ(command.vertexOffset, firstVertexOf(scene, scene.instances[row].primitive,
                                                              scene.instances[row].skinnedMesh));
                ASSERT_EQ(scene.instances[row].movable, c >= range.staticCount);
            }
        }
    std::ranges::sort(all);
    ASSERT_EQ(all.size(), scene.instances.size());
    for (uint32_t i = 0; i < all.size(); ++i)
        ASSERT_EQ(all[i], i);
    EXPECT_LT(draws.commands.size(), 200u);
}

TEST(DrawLists, WhatIsPickedIsWhatTheViewDrawsOfTheRows) {
    Lists l("crowd", 500);
    const ViewDraws& all = l.seenByCamera();
    const std::vector<RenderScene::Range> rows = {{3, 4}, {10, 200}, {300, 420}};
    const ViewDraws& some = l.lists.pick(1, all, rows);
    std::vector<uint32_t> expected;
    for (const uint32_t row : all.rows)
        if (row == 3 || (row >= 10 && row < 200) || (row >= 300 && row < 420)) expected.push_back(row);
    EXPECT_GT(expected.size(), 20u);
    EXPECT_EQ(some.rows, expected);
}

// 200 punctual lights among 10,000 boxes: each light draws all that it sees into six faces.
TEST(DrawLists, ManyViewsOfManyInstancesStaySmall) {
    const SceneAsset asset = *scenegen::buildScene("crowd", 10000);
    RenderScene scene = staticScene(asset);
    JobRunner jobs(2);
    DrawLists lists;
    lists.beginFrame(scene, jobs);
    std::mt19937 random(5);
    std::uniform_real_distribution<float> unit;
    std::vector<ViewRequest> views;
    for (uint32_t light = 0; light < 200; ++light) {
        const glm::vec3 at = scene.bounds.min + glm::vec3(unit(random), unit(random), unit(random)) *
                                                    (scene.bounds.max - scene.bounds.min);
        for (uint32_t face = 0; face < 6; ++face)
            views.push_back({light * 6 + face, cubeFaceView(at, face, 1000).clipFromWorld});
    }
    lists.cullAll(scene, views);
    size_t drawn = 0;
    for (const ViewRequest& view : views)
        drawn += lists.cull(scene, view.slot, view.clipFromWorld).rows.size();
    const size_t bytes = lists.commandCapacity() * sizeof(VkDrawIndexedIndirectCommand) +
                         lists.rowCapacity() * sizeof(uint32_t);
    std::printf("%zu instances drawn, %.1f MB of commands and rows\n", drawn, double(bytes) / 1e6);
    EXPECT_GT(drawn, 200u * 10000u) << "all are seen";
    EXPECT_LT(bytes, 40e6);
}

// A list's range is its own, and what is given back is used again.
TEST(RangePool, RangesNeverMeetAndAreUsedAgain) {
    RangePool pool;
    std::vector<RangePool::Range> ranges(64);
    std::mt19937 random(7);
    for (int turn = 0; turn < 400; ++turn) {
        RangePool::Range& range = ranges[random() % ranges.size()];
        const uint32_t count = random() % 3 == 0 ? 0 : random() % 3000;
        pool.fit(range, count);
        EXPECT_GE(range.capacity, count);
        for (const RangePool::Range& other : ranges) {
            if (&other == &range || other.capacity == 0 || range.capacity == 0) continue;
            ASSERT_TRUE(other.first + other.capacity <= range.first ||
                        range.first + range.capacity <= other.first);
        }
    }
    const uint32_t size = pool.size();
    std::vector<uint32_t> capacities;
    for (RangePool::Range& range : ranges) {
        capacities.push_back(range.capacity);
        pool.fit(range, 0);
    }
    for (size_t i = 0; i < ranges.size(); ++i)
        pool.fit(ranges[i], capacities[i]);
    EXPECT_EQ(pool.size(), size);
}

}  // namespace
}  // namespace ag::gi
