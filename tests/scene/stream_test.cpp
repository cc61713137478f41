// What the renderer is told of moving things: rows, changed ranges, bounds, culling; and movers.
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <random>

#include "engine/ecs/schedule.h"
#include "engine/scene/extract_system.h"
#include "engine/scene/mover.h"
#include "engine/scene/spawn_scene.h"
#include "engine/scene/transform_system.h"
#include "tools/scenegen/scenes.h"

namespace ag {
namespace {

struct Seconds {
    double now = 0;
};

struct Stage {
    SceneAsset asset;
    World world;
    Schedule schedule;
    JobRunner runner;

    Stage(uint32_t count, uint32_t threads) : asset(*scenegen::buildScene("crowd", count)), runner(threads) {
        spawnScene(world, asset);
        world.setResource<Seconds>();
        world.setResource<ExtractState>();
        world.setResource<ActiveCamera>(cameraOf(asset, 0));
        world.setResource<RenderScene>().geometry = &asset.geometry;
        schedule.add("move", [](View<LocalTransform, const Mover> movers, Res<const Seconds> time,
                                JobRunner& jobs) { moveAlong(movers, time->now, jobs); });
        schedule.add("roots", updateRootTransforms);
        schedule.add("children", updateChildTransforms);
        schedule.add("extract", extractScene);
    }
    void frame(double step) {
        world.resource<Seconds>().now += step;
        schedule.run(world, runner);
    }
    RenderScene& scene() { return world.resource<RenderScene>(); }
};

bool equal(const RenderInstance& a, const RenderInstance& b) {
    return a.worldFromLocal == b.worldFromLocal && a.primitive == b.primitive && a.movable == b.movable;
}

Bounds boundsOf(const RenderScene& scene, size_t row) {
    const RenderInstance& instance = scene.instances[row];
    const Bounds& local = scene.geometry->primitives[instance.primitive].boundsLocal;
    Bounds b;
    for (int corner = 0; corner < 8; ++corner)
        b.add(instance.worldFromLocal * glm::vec4(corner & 1 ? local.max.x : local.min.x,
                                                  corner & 2 ? local.max.y : local.min.y,
                                                  corner & 4 ? local.max.z : local.min.z, 1));
    return b;
}

// A copy kept by changed ranges alone is the scene, whatever happens to the world; on any number of threads.
TEST(Stream, ChangedRangesAreAllThatChanged) {
    Stage one(12'000, 1), four(12'000, 4);  // enough rows to be worth splitting
    std::vector<RenderInstance> copy;
    std::mt19937 random(8);
    uint32_t steps = 0, ranged = 0;
    for (int turn = 0; turn < 60; ++turn) {
        const uint32_t what = random() % 6, pick = random();
        const double step = turn % 3 ? 1.0 / 60 : 0;  // every third frame nothing moves by itself
        for (Stage* s : {&one, &four}) {
            std::vector<Entity> all;
            View<const MeshInstance>(s->world, {}).each([&](Entity e, const MeshInstance&) {
                all.push_back(e);
            });
            const Entity entity = all[pick % all.size()];
            if (what == 0) s->world.destroy(entity);
            if (what == 1) {
                const MeshInstance mesh = *s->world.get<MeshInstance>(entity);
                s->world.create(LocalTransform{.translation = {double(turn), 3, 0}}, WorldTransform{}, mesh);
            }
            if (what == 2) s->world.write<LocalTransform>(entity)->scale *= 1.5f;
            if (what == 3) s->world.remove<Mover>(entity);
            if (what == 4 && turn % 20 == 4) s->world.resource<ActiveCamera>().pose.position.x += 3000;
            s->frame(step);
        }
        const RenderScene& scene = one.scene();
        if (scene.allInstancesChanged) copy = scene.instances;
        copy.resize(scene.instances.size(), {.primitive = kNoPrimitive});
        if (!scene.allInstancesChanged)
            for (const RenderScene::Range& r : scene.changedInstances) {
                std::copy(scene.instances.begin() + r.begin, scene.instances.begin() + r.end,
                          copy.begin() + r.begin);
                ranged += r.end - r.begin;
            }
        ++steps;
        ASSERT_EQ(copy.size(), scene.instances.size());
        Bounds bounds;
        for (size_t i = 0; i < copy.size(); ++i) {
            ASSERT_TRUE(equal(copy[i], scene.instances[i])) << "row " << i << " of turn " << turn;
            ASSERT_TRUE(equal(four.scene().instances[i], scene.instances[i]));
            if (copy[i].isPresent()) bounds.add(boundsOf(scene, i));
        }
        for (int k = 0; k < 3; ++k) {
            EXPECT_NEAR(scene.bounds.min[k], bounds.min[k], 1e-3f);
            EXPECT_NEAR(scene.bounds.max[k], bounds.max[k], 1e-3f);
        }
        ASSERT_EQ(one.world.stateHash(), four.world.stateHash());
        ASSERT_EQ(four.scene().instancesVersion, scene.instancesVersion);
        ASSERT_EQ(four.scene().changedInstances.size(), scene.changedInstances.size());
    }
    EXPECT_GT(ranged, 50000u) << "most frames stream ranges";
}

// Those who stay keep their rows, those who come take rows of those who left, and only these are told of.
TEST(Stream, WhatComesAndGoesIsAllThatIsReplaced) {
    Stage s(600, 1);
    s.frame(0.1);
    s.frame(0);
    const MeshInstance box = [&] {
        MeshInstance mesh;
        View<const MeshInstance, const Mover>(s.world, {}).each([&](const MeshInstance& m, const Mover&) {
            mesh = m;
        });
        return mesh;
    }();
    std::vector<Entity> guests;
    const size_t rows = s.scene().instances.size();
    for (int turn = 0; turn < 20; ++turn) {
        const std::vector<RenderInstance> before = s.scene().instances;
        const size_t left = guests.size() / 2;
        s.world.destroy(std::span(guests).first(left));
        guests.erase(guests.begin(), guests.begin() + long(left));
        for (int i = 0; i < 30; ++i)
            guests.push_back(s.world.create(LocalTransform{.translation = {double(i), 2, double(turn)}},
                                            WorldTransform{}, box));
        s.frame(0);
        const RenderScene& scene = s.scene();
        EXPECT_FALSE(scene.allInstancesChanged);
        std::vector<bool> replaced(scene.instances.size(), false);
        for (const RenderScene::Range& r : scene.replacedInstances)
            for (uint32_t row = r.begin; row < r.end; ++row)
                replaced[row] = true;
        EXPECT_LE(size_t(std::ranges::count(replaced, true)), left + 30);
        for (size_t row = 0; row < before.size(); ++row)
            EXPECT_TRUE(replaced[row] || equal(before[row], scene.instances[row])) << row;
        size_t present = 0;
        for (const RenderInstance& instance : scene.instances)
            present += instance.isPresent();
        EXPECT_EQ(present, rows + guests.size());
    }
    EXPECT_LE(s.scene().instances.size(), rows + 95) << "rows of those who left are used again";
}

TEST(Stream, NothingMovesNothingIsTold) {
    Stage s(300, 1);
    s.frame(0.1);
    s.frame(0);
    const uint64_t version = s.scene().instancesVersion;
    s.frame(0);
    EXPECT_EQ(s.scene().instancesVersion, version);
    EXPECT_TRUE(s.scene().changedInstances.empty());
    EXPECT_FALSE(s.scene().allInstancesChanged);
    s.world.advanceFrame();
    Entity mover;
    View<const Mover, const MeshInstance>(s.world, {}).each([&](Entity e, const Mover&, const MeshInstance&) {
        mover = e;
    });
    s.world.write<Mover>(mover)->origin.y += 5;
    s.frame(0);
    ASSERT_EQ(s.scene().changedInstances.size(), 1u);
    EXPECT_EQ(s.scene().changedInstances[0].end - s.scene().changedInstances[0].begin, 1u);
    EXPECT_EQ(s.scene().instancesVersion, version + 1);
}

TEST(Stream, CullingKeepsWhatTheCameraSeesAndDropsWhatIsBehindAPlane) {
    Stage s(5000, 2);
    s.frame(0.3);
    const InstanceBounds& bounds = s.world.resource<ExtractState>().bounds;
    ASSERT_EQ(bounds.size(), s.scene().instances.size());
    const auto& camera = s.scene().camera;
    const auto planes = viewPlanes(camera.clipFromWorld);
    std::vector<uint64_t> visible;
    bounds.cull(planes, visible, s.runner);
    uint32_t seen = 0, dropped = 0;
    for (uint32_t row = 0; row < bounds.size(); ++row) {
        const bool kept = visible[row / 64] >> (row % 64) & 1;
        const Bounds box = boundsOf(s.scene(), row);
        const glm::vec4 clip = camera.clipFromWorld * glm::vec4((box.min + box.max) * 0.5f, 1);
        const bool centreInside = std::abs(clip.x) < clip.w && std::abs(clip.y) < clip.w && clip.z < clip.w;
        if (centreInside) {
            EXPECT_TRUE(kept) << row;
        }
        bool behind = false;  // all corners behind one plane, clearly
        for (const glm::vec4& plane : planes) {
            float most = -1e30f;
            for (int c = 0; c < 8; ++c)
                most = std::max(most, glm::dot(plane, glm::vec4(c & 1 ? box.max.x : box.min.x,
                                                                c & 2 ? box.max.y : box.min.y,
                                                                c & 4 ? box.max.z : box.min.z, 1)));
            behind = behind || most < -1e-3f;
        }
        if (behind) {
            EXPECT_FALSE(kept) << row;
        }
        (kept ? seen : dropped) += 1;
    }
    EXPECT_GT(seen, 500u);
    s.world.resource<ActiveCamera>().pose.forward = {0, 0, 1};  // away from all
    s.frame(0);
    bounds.cull(viewPlanes(s.scene().camera.clipFromWorld), visible, s.runner);
    uint32_t left = 0;
    for (const uint64_t word : visible)
        left += uint32_t(std::popcount(word));
    EXPECT_LT(left, 10u) << "the camera stands before the crowd and looks the other way";
}

TEST(Mover, SineIsTheSine) {
    for (double turns = -3; turns < 3; turns += 0.00317)
        EXPECT_NEAR(sineOfTurns(turns), std::sin(2 * std::numbers::pi * turns), 2e-7) << turns;
    EXPECT_EQ(sineOfTurns(0), 0);
    EXPECT_NEAR(sineOfTurns(1e6 + 0.25), 1, 2e-7) << "late times keep their precision";
}

TEST(Mover, SlidesAndTurns) {
    const Mover m{
        .origin = {1e6, 2, 3}, .extent = {4, 0, 0}, .period = 8, .spinSpeed = 0.5f, .startYaw = 0.25f};
    LocalTransform at;
    place(m, 2, at);
    EXPECT_NEAR(at.translation.x, 1e6 + 4, 1e-5);
    EXPECT_EQ(at.translation.y, 2);
    const glm::quat turned = glm::angleAxis(1.25f, glm::vec3(0, 1, 0));
    EXPECT_NEAR(std::abs(glm::dot(at.rotation, turned)), 1, 1e-6);
    place(m, 4, at);
    EXPECT_NEAR(at.translation.x, 1e6, 1e-5);
}

}  // namespace
}  // namespace ag
