// Skinned meshes: what an animation makes of joints, joints of vertices, and how a world keeps up with it.
#include "engine/scene/skinned_mesh.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "engine/ecs/schedule.h"
#include "engine/ecs/snapshot.h"
#include "engine/scene/animation.h"
#include "engine/scene/animation_system.h"
#include "engine/scene/deform.h"
#include "engine/scene/describe_components.h"
#include "engine/scene/spawn_scene.h"
#include "engine/scene/static_scene.h"
#include "engine/scene/transform_system.h"
#include "tests/scene/bar.h"
#include "tools/scenegen/figures.h"

namespace ag {
namespace {

constexpr float kHalfPi = std::numbers::pi_v<float> / 2;

TEST(Animation, TurnsAlongTheShorterArc) {
    std::mt19937 random(3);
    std::normal_distribution<float> g;
    for (int i = 0; i < 2000; ++i) {
        const glm::quat a = glm::normalize(glm::quat(g(random), g(random), g(random), g(random)));
        const glm::quat b = glm::normalize(glm::quat(g(random), g(random), g(random), g(random)));
        const float t = float(i) / 2000;
        const glm::quat mine = slerpQuat(a, b, t), theirs = glm::slerp(a, b, t);
        EXPECT_NEAR(std::abs(glm::dot(mine, theirs)), 1, 1e-6f);
        EXPECT_NEAR(glm::length(mine), 1, 1e-6f);
    }
}

TEST(Animation, InterpolatesAsGltfSays) {
    SceneChannel c{.times = {1, 3}, .values = {{0, 0, 0, 0}, {4, 0, 0, 0}}};
    EXPECT_FLOAT_EQ(sampleChannel(c, 0).x, 0) << "before the first time";
    EXPECT_FLOAT_EQ(sampleChannel(c, 2.5f).x, 3);
    EXPECT_FLOAT_EQ(sampleChannel(c, 9).x, 4) << "after the last";
    c.interpolation = Interpolation::kStep;
    EXPECT_FLOAT_EQ(sampleChannel(c, 2.9f).x, 0);
    EXPECT_FLOAT_EQ(sampleChannel(c, 3).x, 4);
    c.interpolation = Interpolation::kCubic;  // in, value, out; slopes of x^3 / 2 from 1 on
    c.values = {{0, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}, {6, 0, 0, 0}, {4, 0, 0, 0}, {0, 0, 0, 0}};
    EXPECT_FLOAT_EQ(sampleChannel(c, 2).x, 0.5f);
    EXPECT_FLOAT_EQ(sampleChannel(c, 1).x, 0);
    EXPECT_FLOAT_EQ(sampleChannel(c, 3).x, 4);
}

TEST(Animation, GoesRoundOrHolds) {
    EXPECT_FLOAT_EQ(advanceClip(2.5f, 1, 3, true), 0.5f);
    EXPECT_FLOAT_EQ(advanceClip(0.5f, -1, 3, true), 2.5f);
    EXPECT_FLOAT_EQ(advanceClip(2.5f, 1, 3, false), 3);
    EXPECT_FLOAT_EQ(advanceClip(2.5f, 1, 0, true), 0);
}

TEST(SkinnedMesh, ABentBarIsWhereItShouldBe) {
    SceneAsset asset = test::bar();
    asset.nodes[3].extras.clipStart = 1;
    const RenderScene scene = staticScene(asset);
    ASSERT_EQ(scene.skinnedMeshes.size(), 1u);
    ASSERT_EQ(scene.instances.size(), 1u);
    EXPECT_TRUE(scene.instances[0].movable);
    const DeformedVertices v = deformSkinnedMeshes(scene);
    // Its own node's place does not count, its joints' frame does.
    const auto world = [&](size_t i) {
        return scene.instances[0].worldFromLocal * glm::vec4(v.positions[i], 1);
    };
    const glm::vec3 expected[] = {{5.2f, 0, 0}, {5.3f, 2.3f, 0}, {3, 2.2f, 0}};
    for (size_t i = 0; i < 3; ++i)
        EXPECT_LT(glm::length(world(i) - expected[i]), 1e-5f) << i;
    EXPECT_LT(glm::length(v.attributes[2].normal - glm::vec3(0, 1, 0)), 1e-6f);
    EXPECT_LT(glm::length(v.attributes[1].normal - glm::normalize(glm::vec3(1, 1, 0))), 1e-6f);
    EXPECT_LT(glm::length(glm::vec3(v.attributes[2].tangent) - glm::vec3(-1, 0, 0)), 1e-6f);
    const Bounds& b = scene.skinnedMeshes[0].boundsLocal;
    for (const glm::vec3 at : v.positions) {
        EXPECT_TRUE(glm::all(glm::greaterThanEqual(at, b.min - 1e-5f)));
        EXPECT_TRUE(glm::all(glm::lessThanEqual(at, b.max + 1e-5f)));
    }
}

TEST(SkinnedMesh, HalfTheTimeIsHalfTheAngle) {
    SceneAsset asset = test::bar();
    asset.nodes[3].extras.clipStart = 0.5f;
    const RenderScene scene = staticScene(asset);
    const glm::vec3 tip = deformSkinnedMeshes(scene).positions[2];
    const float angle = kHalfPi / 2;
    const glm::vec3 expected(0.1f * std::cos(angle) - std::sin(angle),
                             1 + 0.1f * std::sin(angle) + std::cos(angle), 0);
    EXPECT_LT(glm::length(tip - expected), 2e-6f);
}

TEST(SkinnedMesh, StretchedNormalsStayAcross) {
    SceneAsset asset = test::bar();
    asset.nodes[3].extras.clip = -1;
    asset.nodes[2].local.scale = {1, 4, -2};
    asset.geometry.attributes[2].normal = glm::normalize(glm::vec3(0, 1, 1));
    const RenderScene scene = staticScene(asset);
    const glm::vec3 n = deformSkinnedMeshes(scene).attributes[2].normal;
    // Of the plane that (0, 1, -1) and x lie in, which become (0, 4, 2) and x; turned over with the mirror.
    EXPECT_NEAR(glm::dot(n, glm::vec3(0, 4, 2)), 0, 1e-5f);
    EXPECT_NEAR(glm::length(n), 1, 1e-6f);
    EXPECT_GT(n.y, 0);
}

TEST(SkinnedMesh, BoundsHoldEveryVertex) {
    const SceneAsset asset = scenegen::figures(9);
    const RenderScene scene = staticScene(asset);
    const DeformedVertices v = deformSkinnedMeshes(scene);
    for (const RenderSkinnedMesh& f : scene.skinnedMeshes) {
        Bounds tight;
        for (uint32_t i = 0; i < f.vertexCount; ++i)
            tight.add(v.positions[f.firstDeformed + i]);
        EXPECT_TRUE(glm::all(glm::lessThanEqual(f.boundsLocal.min, tight.min + 1e-5f)));
        EXPECT_TRUE(glm::all(glm::greaterThanEqual(f.boundsLocal.max, tight.max - 1e-5f)));
        EXPECT_LT(glm::length(f.boundsLocal.max - f.boundsLocal.min),
                  1.5f * glm::length(tight.max - tight.min));
    }
}

struct Stage {
    SceneAsset asset;
    World world;
    Schedule schedule;
    JobRunner runner;
    std::vector<Entity> players;

    explicit Stage(SceneAsset built, uint32_t threads) : asset(std::move(built)), runner(threads) {
        spawnScene(world, asset);
        world.setResource<ExtractState>();
        world.setResource<ActiveCamera>();
        world.setResource<RenderScene>().geometry = &asset.geometry;
        schedule.add("play", [](View<AnimationPlayer> all, Res<const SkinnedMeshLibrary> library,
                                JobRunner& jobs) { advancePlayers(all, *library, 1.0f / 60, jobs); });
        schedule.add("nodes", animateNodes);
        schedule.add("roots", updateRootTransforms);
        schedule.add("children", updateChildTransforms);
        schedule.add("pose", poseSkinnedMeshes);
        schedule.add("extract", extractScene);
        View<const SkinnedMesh, const AnimationPlayer>(world, {}).each(
            [&](Entity e, const SkinnedMesh&, const AnimationPlayer&) { players.push_back(e); });
    }
    void frame() { schedule.run(world, runner); }
    RenderScene& scene() { return world.resource<RenderScene>(); }
};

TEST(SkinnedMesh, AWorldPosesAsOneSceneDoes) {
    Stage s(scenegen::figures(7), 2);
    for (const Entity e : s.players)
        s.world.write<AnimationPlayer>(e)->speed = 0;
    s.frame();
    const RenderScene still = staticScene(s.asset, s.scene().originWorld);
    ASSERT_EQ(s.scene().skinnedMeshes.size(), still.skinnedMeshes.size());
    const DeformedVertices a = deformSkinnedMeshes(s.scene()), b = deformSkinnedMeshes(still);
    EXPECT_EQ(a.positions, b.positions);
    size_t skinnedMeshes = 0;
    for (const RenderInstance& i : s.scene().instances)
        if (i.skinnedMesh != kNoSkinnedMesh) {
            ++skinnedMeshes;
            EXPECT_TRUE(i.movable);
        }
    EXPECT_EQ(skinnedMeshes, 14u) << "two primitives each";
}

TEST(SkinnedMesh, OnlyThoseThatMoveAreMarked) {
    Stage s(scenegen::figures(7), 1);
    for (size_t i = 0; i < s.players.size(); ++i)
        s.world.write<AnimationPlayer>(s.players[i])->speed = i == 3;
    s.frame();
    EXPECT_TRUE(s.scene().allInstancesChanged);
    const uint64_t before = s.scene().instancesVersion;
    const std::vector<RenderSkinnedMesh> skinnedMeshes = s.scene().skinnedMeshes;
    s.frame();
    EXPECT_FALSE(s.scene().allInstancesChanged);
    EXPECT_EQ(s.scene().instancesVersion, before + 1);
    ASSERT_EQ(s.scene().changedInstances.size(), 1u);
    const RenderScene::Range range = s.scene().changedInstances[0];
    EXPECT_EQ(range.end - range.begin, 2u);
    EXPECT_EQ(s.scene().instances[range.begin].skinnedMesh, 3u);
    for (size_t i = 0; i < skinnedMeshes.size(); ++i)
        EXPECT_EQ(skinnedMeshes[i].poseVersion == s.scene().skinnedMeshes[i].poseVersion, i != 3);
    s.world.write<AnimationPlayer>(s.players[3])->speed = 0;
    s.frame();
    EXPECT_EQ(s.scene().instancesVersion, before + 1) << "at rest nothing changes";
    s.world.destroy(s.players[1]);
    s.frame();
    EXPECT_TRUE(s.scene().allInstancesChanged);
    EXPECT_EQ(s.scene().skinnedMeshes.size(), 6u);
}

TEST(SkinnedMesh, ThreadsAndSnapshotsShowInNoBit) {
    describeSceneComponents();
    Stage one(scenegen::figures(40), 1), four(scenegen::figures(40), 4);
    for (int i = 0; i < 5; ++i)
        one.frame(), four.frame();
    EXPECT_EQ(one.scene().joints, four.scene().joints);
    const std::vector<std::byte> saved = saveWorld(one.world);
    for (int i = 0; i < 9; ++i)
        one.frame(), four.frame();
    const std::vector<glm::mat3x4> after = one.scene().joints;
    EXPECT_EQ(four.scene().joints, after);
    ASSERT_TRUE(restoreWorld(one.world, saved));
    for (int i = 0; i < 9; ++i)
        one.frame();
    EXPECT_EQ(one.scene().joints, after);
    EXPECT_EQ(one.world.stateHash(), four.world.stateHash());
}

// A lamp on a node that an animation moves: no joint, so the entity itself moves.
TEST(SkinnedMesh, NodesThatAreNoJointsMoveToo) {
    SceneAsset asset = test::bar();
    asset.lights.push_back({.name = "lamp"});
    asset.nodes.push_back(
        {.name = "lamp", .parent = 2, .depth = 3, .local = {.translation = {0, 1, 0}}, .light = 0});
    Stage s(std::move(asset), 1);
    for (int i = 0; i < 30; ++i)
        s.frame();
    ASSERT_EQ(s.scene().lights.size(), 1u);
    const glm::vec3 lamp = s.scene().lights[0].position + glm::vec3(s.scene().originWorld);
    const float angle = kHalfPi / 2;
    EXPECT_LT(glm::length(lamp - glm::vec3(5 - 2 * std::sin(angle), 2 + 2 * std::cos(angle), 0)), 1e-4f);
}

}  // namespace
}  // namespace ag
