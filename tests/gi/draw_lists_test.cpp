// What views draw: culled one by one or all at once as jobs, it is what a plain test of every box says.
#include <gtest/gtest.h>

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
            ASSERT_EQ(a.instanceCount, b.instanceCount);
            uint32_t expected = 0;
            for (const RenderInstance& instance : scene.instances)
                expected += inSight(scene, instance, view.clipFromWorld);
            EXPECT_NEAR(a.instanceCount, expected, 2) << "boxes that only touch";
            drawn += a.instanceCount;
        }
        ASSERT_EQ(serial.commands().size(), jobs.commands().size());
        EXPECT_EQ(
            std::memcmp(serial.commands().data(), jobs.commands().data(), serial.commands().size_bytes()), 0);
        EXPECT_GT(drawn, 1000u);
        const uint32_t row = random() % uint32_t(scene.instances.size());
        scene.instances[row].worldFromLocal[3].y += 0.5f;
        scene.changedInstances = {{row, row + 1}};
        scene.allInstancesChanged = false;
        ++scene.instancesVersion;
    }
}

TEST(DrawLists, WhatIsTurnedOverIsDrawnFromABucketOfItsOwn) {
    const SceneAsset asset = *scenegen::buildScene("cornell", 0);
    RenderScene scene = staticScene(asset);
    setCamera(scene, cameraOf(asset, 0), {160, 90});
    JobRunner one(1);
    DrawLists lists;
    for (int turn = 0; turn < 4; ++turn) {
        lists.beginFrame(scene, one);
        const ViewDraws& draws = lists.cull(scene, 0, scene.camera.clipFromWorld);
        EXPECT_EQ(draws.instanceCount, scene.instances.size());
        for (size_t b = 0; b < draws.buckets.size(); ++b)
            for (uint32_t c = 0; c < draws.buckets[b].commandCount; ++c) {
                const uint32_t row = lists.commands()[draws.buckets[b].firstCommand + c].firstInstance;
                EXPECT_EQ(lists.buckets()[b].mirrored, row == 1 && turn % 2 == 1);
            }
        scene.instances[1].worldFromLocal[0] *= -1.0f;
        scene.changedInstances = {{1, 2}};
        scene.allInstancesChanged = false;
        ++scene.instancesVersion;
    }
}

}  // namespace
}  // namespace ag::gi
