// Things and materials edited in the viewer: what is under the mouse, how the scene follows, undo.
#include <gtest/gtest.h>

#include <cmath>

#include "tools/scenegen/scenes.h"
#include "tools/viewer/edit_history.h"
#include "tools/viewer/edited_scene.h"
#include "tools/viewer/picking.h"
#include "tools/viewer/sky_sun.h"

namespace ag::viewer {
namespace {

EditState withLight(EditState state, float x) {
    state.lights.push_back({.position = {x, 0, 0}});
    return state;
}

TEST(EditHistory, ADragIsOneEdit) {
    EditHistory edits;
    EditState now;
    now.lights.resize(1);
    edits.note(now, false);
    EXPECT_FALSE(edits.undo(now)) << "nothing was done";
    const EditState start = now;
    for (int i = 0; i < 5; ++i) {  // one drag, with pauses
        now.lights[0].position.x += 1;
        edits.note(now, true);
        edits.note(now, true);
    }
    edits.note(now, false);
    const EditState dragged = now;
    now = withLight(now, 3);
    edits.note(now, false);
    edits.note(now, false);

    EXPECT_TRUE(edits.undo(now));
    EXPECT_EQ(now, dragged);
    edits.note(now, false);
    EXPECT_TRUE(edits.undo(now));
    EXPECT_EQ(now, start);
    EXPECT_FALSE(edits.undo(now));
    EXPECT_TRUE(edits.redo(now));
    EXPECT_EQ(now, dragged);
    edits.note(now, false);
    now.lights[0].intensity *= 2.0f;  // something new: what was undone is gone
    edits.note(now, false);
    EXPECT_FALSE(edits.redo(now));
    EXPECT_TRUE(edits.undo(now));
    EXPECT_EQ(now, dragged);
}

TEST(EditHistory, HoldsThingsMaterialsAndTheSky) {
    EditHistory edits;
    EditState now;
    edits.note(now, false);
    std::vector<EditState> states = {now};
    now.assets.moves.push_back({3, {1, 0, 0}});
    states.push_back(now), edits.note(now, false);
    now.assets.looks.push_back({.material = 2, .roughness = 0.5f});
    states.push_back(now), edits.note(now, false);
    now.sky = std::make_shared<const Sky>(constantSky(glm::vec3(1)));
    states.push_back(now), edits.note(now, false);
    for (size_t i = states.size() - 1; i-- > 0;) {
        ASSERT_TRUE(edits.undo(now));
        EXPECT_EQ(now, states[i]) << i;
    }
    for (size_t i = 1; i < states.size(); ++i) {
        ASSERT_TRUE(edits.redo(now));
        EXPECT_EQ(now, states[i]) << i;
    }
}

// A triangle, and one in front of it that is twice as large and has a lamp upon it.
SceneAsset smallAsset() {
    SceneAsset asset;
    GeometryArrays& g = asset.geometry;
    g.positions = {{-1, 0, 0}, {1, 0, 0}, {0, 2, 0}};
    g.attributes.resize(3);
    g.indices = {0, 1, 2};
    g.primitives = {{.indexCount = 3, .boundsLocal = {{-1, 0, 0}, {1, 2, 0}}}};
    g.materials = {{.name = "red", .baseColor = {0.8f, 0.1f, 0.1f, 1}}};
    asset.meshes = {{"triangle", 0, 1}};
    asset.lights = {{.name = "lamp"}};
    asset.nodes = {
        {.name = "back", .local = {.translation = {0, 0, -5}}, .mesh = 0},
        {.name = "turned", .local = {.scale = {2, 2, 2}}},
        {.name = "front", .parent = 1, .depth = 1, .mesh = 0},
        {.name = "its lamp", .parent = 2, .depth = 2, .local = {.translation = {0, 1, 0}}, .light = 0}};
    return asset;
}

Screen screenFrom(glm::dvec3 eye) {
    return {{.position = eye, .forward = {0, 0, -1}, .verticalFov = 1}, {200, 100}};
}

TEST(Picking, RaysGoWhereThingsAreProjected) {
    Screen s = screenFrom({1, 2, 3});
    s.pose.forward = glm::normalize(glm::vec3(0.3f, -0.2f, -1));
    for (const glm::dvec3 place : {glm::dvec3(0, 0, -4), {3, 1, -9}, {-2, 4, -7}}) {
        const auto pixel = projected(s, place);
        ASSERT_TRUE(pixel);
        const glm::vec3 way(glm::normalize(place - s.pose.position));
        EXPECT_NEAR(glm::dot(rayThrough(s, *pixel), way), 1, 1e-6);
    }
}

TEST(Picking, TheNearestTriangleWhateverTheOrigin) {
    const SceneAsset asset = smallAsset();
    for (const glm::dvec3 origin : {glm::dvec3(0), {1000, -200, 50}}) {
        const RenderScene scene = staticScene(asset, origin);
        const auto from = [&](glm::dvec3 eye, glm::vec3 way) {
            return pick(scene, glm::vec3(eye - origin), way);
        };
        const auto both = from({0, 1, 10}, {0, 0, -1});
        ASSERT_TRUE(both);
        EXPECT_EQ(both->instance, 1u) << "the front one is twice as large";
        EXPECT_NEAR(both->distance, 10, 1e-3);
        const auto behind = from({0, 1, -2}, {0, 0, -1});
        ASSERT_TRUE(behind);
        EXPECT_EQ(behind->instance, 0u);
        EXPECT_TRUE(from({0, 1, -10}, {0, 0, 1})) << "from behind, too";
        EXPECT_FALSE(from({1.9, 3.9, 10}, {0, 0, -1})) << "in the box, beside the triangle";
        EXPECT_FALSE(from({0, 1, 10}, {0, 0, 1}));
    }
}

TEST(EditedScene, AThingTakesWhatIsBelowItAlong) {
    SceneAsset asset = smallAsset();
    RenderScene scene = staticScene(asset, {10, 0, 0});
    EditedScene edited(asset, scene, {});
    EXPECT_EQ(edited.thingOf(1), 2u);
    EXPECT_EQ(edited.nameOf(2), "front");
    const auto front = scene.instances[1].worldFromLocal[3];
    const glm::vec3 lamp = scene.lights[0].position;
    const uint64_t instances = scene.instancesVersion, lights = scene.lightsVersion;

    AssetEdits wanted{.moves = {{1, {0, 3, 1}}}};  // the node above it
    EXPECT_TRUE(edited.follow(wanted).lights);
    EXPECT_EQ(scene.instances[1].worldFromLocal[3], front + glm::vec3(0, 3, 1));
    EXPECT_EQ(scene.lights[0].position, lamp + glm::vec3(0, 3, 1));
    EXPECT_EQ(scene.instancesVersion, instances + 1);
    EXPECT_EQ(scene.lightsVersion, lights + 1);
    EXPECT_TRUE(scene.allInstancesChanged) << "it was among what is still";
    EXPECT_TRUE(scene.instances[1].movable);
    EXPECT_FALSE(scene.instances[0].movable);
    EXPECT_FALSE(edited.follow(wanted).lights) << "nothing new";
    EXPECT_EQ(scene.instancesVersion, instances + 1);
    edited.rendered();
    EXPECT_FALSE(scene.allInstancesChanged);

    wanted.moves.push_back({2, {1, 0, 0}});  // itself, too: in the world's metres, not its parent's
    edited.follow(wanted);
    EXPECT_EQ(scene.instances[1].worldFromLocal[3], front + glm::vec3(1, 3, 1));
    EXPECT_FALSE(scene.allInstancesChanged);
    ASSERT_EQ(scene.changedInstances.size(), 1u);
    EXPECT_EQ(scene.changedInstances[0].begin, 1u);
    EXPECT_FLOAT_EQ(scene.bounds.max.y, 2 * 2 + 3);

    edited.follow({});
    EXPECT_EQ(scene.instances[1].worldFromLocal[3], front);
    EXPECT_EQ(scene.lights[0].position, lamp);
}

TEST(EditedScene, LampsInARowMoveOnceEach) {
    SceneAsset asset = smallAsset();
    const auto lamp = std::ranges::find_if(asset.nodes, [](const SceneNode& n) { return n.light >= 0; });
    ASSERT_NE(lamp, asset.nodes.end());
    SceneNode next = *lamp;
    next.local.translation += glm::vec3(1, 0, 0);
    asset.nodes.push_back(next);
    RenderScene scene = staticScene(asset);
    ASSERT_EQ(scene.lights.size(), 2u);
    EditedScene edited(asset, scene, {});
    const glm::vec3 first = scene.lights[0].position, second = scene.lights[1].position;
    edited.follow({.moves = {{1, second - first}}});  // the first comes to stand where the second stood
    EXPECT_EQ(scene.lights[0].position, second);
    EXPECT_EQ(scene.lights[1].position, second + (second - first));
}

TEST(EditedScene, IsWhatALoadedAssetWithTheEditsIs) {
    SceneAsset asset = smallAsset(), again = smallAsset();
    RenderScene scene = staticScene(asset);
    const AssetEdits edits{.moves = {{2, {0.5, 0, 2}}, {1, {0, 1, 0}}, {0, {4, 0, 0}}},
                           .looks = {{.material = 0, .baseColor = {0, 1, 0, 1}, .roughness = 0.3f}}};
    EditedScene(asset, scene, {}).follow(edits);
    ASSERT_TRUE(applyEdits(edits, again));
    const RenderScene loaded = staticScene(again);
    for (size_t i = 0; i < 2; ++i)
        EXPECT_LT(glm::distance(scene.instances[i].worldFromLocal[3], loaded.instances[i].worldFromLocal[3]),
                  1e-6f);
    EXPECT_EQ(scene.lights[0].position, loaded.lights[0].position);
    EXPECT_EQ(scene.bounds.max, loaded.bounds.max);
    EXPECT_EQ(lookOf(asset.geometry, 0), lookOf(again.geometry, 0));
    EXPECT_FALSE(applyEdits({.moves = {{99, {}}}}, again));
    EXPECT_FALSE(applyEdits({.looks = {{.material = 99}}}, again));
}

TEST(EditedScene, MaterialsComeAndGoWithTheirEdits) {
    SceneAsset asset = smallAsset();
    RenderScene scene = staticScene(asset);
    EditedScene edited(asset, scene, {});
    const MaterialLook start = lookOf(asset.geometry, 0);
    const AssetEdits wanted{.looks = {{.material = 0, .metallic = 0, .emissive = {0, 2, 0}}}};
    EXPECT_TRUE(edited.changesMaterials(wanted));
    EXPECT_TRUE(edited.follow(wanted).materials);
    EXPECT_EQ(asset.geometry.version, 2u);
    EXPECT_EQ(lookOf(asset.geometry, 0), wanted.looks[0]);
    EXPECT_FALSE(edited.follow(wanted).materials);
    EXPECT_TRUE(edited.follow({}).materials);
    EXPECT_EQ(lookOf(asset.geometry, 0), start);
    EXPECT_EQ(asset.geometry.version, 3u);
}

TEST(EditedScene, CopiesOfOneNodeOfTheFileAreOneThing) {
    SceneAsset asset = smallAsset();
    asset.nodes[0].source = 5, asset.nodes[1].source = 7;
    const RenderScene loaded = staticScene(asset);
    RenderScene scene = loaded;
    const EditedScene edited(asset, scene, {});
    EXPECT_EQ(edited.thingOf(0), 0u);
    EXPECT_EQ(edited.thingOf(1), 1u) << "the file's node above it";
}

struct Seen {
    RenderScene scene;
    SceneAsset asset;
    render::RenderSettings gi;
    Settings settings;
    FrameGraphOptions graph;
    Viewing viewing{.scene = scene,
                    .asset = asset,
                    .edits = {},
                    .pose = {},
                    .gi = gi,
                    .settings = settings,
                    .graph = graph,
                    .preset = "afterglow"};
};

TEST(SkySun, TurnsWithTheSunsThatWereIts) {
    Seen s;
    const glm::vec3 way = glm::normalize(glm::vec3(1, -1, 0));
    s.scene.sky = std::make_shared<const Sky>(analyticSky(way, 3));
    s.scene.lights = {{.kind = LightKind::kDirectional, .direction = way},
                      {.kind = LightKind::kDirectional, .direction = {0, -1, 0}}};
    const auto handle = skyHandle(s.scene, {0, 1, 0}, 2);
    ASSERT_TRUE(handle);
    EXPECT_LT(glm::distance(handle->place, glm::dvec3(0, 1, 0) - 2.0 * glm::dvec3(way)), 1e-6);

    turnSkySun(s.viewing, {0, 1, 1}, 5);  // from below the horizon: as low as a sun may be
    EXPECT_LT(s.scene.sky->sunDirection.y, 0);
    EXPECT_GT(s.scene.sky->sunDirection.z, 0.99f);
    EXPECT_EQ(s.scene.sky->turbidity, 5);
    EXPECT_EQ(s.scene.lights[0].direction, s.scene.sky->sunDirection);
    EXPECT_EQ(s.scene.lights[1].direction, glm::vec3(0, -1, 0));
    EXPECT_TRUE(s.viewing.skyEdited && s.viewing.lightsEdited);

    s.scene.sky = std::make_shared<const Sky>(constantSky(glm::vec3(1)));
    EXPECT_FALSE(skyHandle(s.scene, {}, 1)) << "a constant sky has no sun";
}

}  // namespace
}  // namespace ag::viewer
