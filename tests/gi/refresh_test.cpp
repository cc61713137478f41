// What may be late, and when nothing may.
#include "gi/refresh.h"

#include <gtest/gtest.h>

#include "engine/renderer/indirect_light.h"
#include "engine/scene/static_scene.h"
#include "tools/scenegen/builder.h"

namespace ag::gi {
using namespace render;
namespace {

// A light over a room, a ball's worth of a box in it.
SceneAsset roomWithBox(float size) {
    scenegen::SceneBuilder room("room");
    const uint32_t white = room.material("white", glm::vec3(0.7f));
    room.room("walls", {-2, 0, -2}, {2, 4, 2}, {white, white, white, white, white, white});
    room.box("box", {0, 0.5f, 0}, glm::vec3(size), white);
    room.spot("lamp", {0, 3.5f, 0}, {0, -1, 0}, glm::vec3(10), {40, 60});
    room.camera("camera", {0, 1, 1.9f}, {0, 1, 0}, 70);
    return room.finish();
}

struct Refreshed {
    SceneAsset asset;
    RenderScene scene;
    JobRunner runner{1};
    DrawLists draws;
    RenderSettings settings;
    RefreshHistory history;
    WorldLists lists;
    float step = 0.002f;  // m, of the box in a frame in which it moves

    explicit Refreshed(float size = 0.1f) : asset(roomWithBox(size)), scene(staticScene(asset)) {
        setCamera(scene, cameraOf(asset, 0), {160, 90});
        scene.instances.back().movable = true;
        settings.bounce.valClustering.settleFrames = 4;
        settings.bounce.refresh = {.lightFrames = 6, .pixelFrames = 3};
    }
    Refresh frame(bool moves) {
        const uint32_t row = uint32_t(scene.instances.size()) - 1;
        scene.changedInstances.clear();
        if (moves) {
            scene.instances.back().worldFromLocal[3].x += step;
            scene.changedInstances = {{row, row + 1}};
            ++scene.instancesVersion;
        }
        draws.beginFrame(scene, runner);
        SceneView view{.scene = &scene, .draws = &draws, .grid = {.size = {160, 90}}};
        view.moved = scene.changedInstances;
        const Refresh refresh =
            chooseRefresh(worldOf(view, lists), scene.camera, view.grid.size, settings.bounce, history);
        scene.allInstancesChanged = false;
        return refresh;
    }
    void settle() {
        for (int i = 0; i < 8; ++i)
            frame(false);
    }
    static bool isAll(const Refresh& r) { return r.lights && !r.pixels.some; }
};

TEST(Refresh, NothingIsLateUnlessASmallThingMoves) {
    Refreshed r;
    for (int i = 0; i < 20; ++i)
        EXPECT_TRUE(r.isAll(r.frame(false)));
    r.frame(true);
    EXPECT_FALSE(r.frame(true).lights);
}

TEST(Refresh, LightsAndPixelsHaveTheirTurns) {
    Refreshed r;
    r.settle();
    std::vector<uint32_t> lightsAt;
    for (uint32_t i = 0; i < 24; ++i) {
        const Refresh now = r.frame(true);
        EXPECT_TRUE(now.pixels.some);
        if (now.lights) {
            lightsAt.push_back(i);
            EXPECT_EQ(now.pixels.count, 1u) << "all pixels follow lights that moved";
        } else {
            EXPECT_EQ(now.pixels.count, 3u);
            EXPECT_EQ(now.pixels.index, (i - lightsAt.back()) % 3);
        }
    }
    EXPECT_EQ(lightsAt, (std::vector<uint32_t>{0, 6, 12, 18}));
}

TEST(Refresh, WhatWaitedComesSoonAfterTheThingHasStopped) {
    Refreshed r;
    r.settle();
    for (int i = 0; i < 9; ++i)
        r.frame(true);
    uint32_t late = 0, lights = 0;
    while (!r.isAll(r.frame(false))) {
        lights += r.history.sinceLights == 0;
        ASSERT_LT(++late, 20u);
    }
    EXPECT_EQ(late, 5u) << "a round of lights, less the frame it stopped in";
    EXPECT_EQ(lights, 1u);
}

TEST(Refresh, WhatIsNotSmallIsNeverLate) {
    Refreshed large(1.5f);
    large.settle();
    Refreshed camera, light, setting, origin;
    for (Refreshed* r : {&camera, &light, &setting, &origin})
        r->settle();
    for (int i = 0; i < 12; ++i) {
        EXPECT_TRUE(large.isAll(large.frame(true)));
        camera.scene.camera.position.x += 0.01f;
        ++camera.scene.cameraVersion;
        light.scene.lights[0].intensity *= 1.01f;
        setting.settings.bounce.importance.viewWeight = 0.1f + 0.05f * float(i);
        ++origin.scene.originVersion;
        for (Refreshed* r : {&camera, &light, &setting, &origin})
            EXPECT_TRUE(r->isAll(r->frame(true)));
    }
    Refreshed exposure;
    exposure.settle();
    exposure.frame(true);
    exposure.settings.composite.exposure = 1;
    EXPECT_FALSE(exposure.frame(true).lights) << "how light is shown does not count";
}

TEST(Refresh, AfterALargeChangeAllSettlesFirst) {
    Refreshed r;
    r.settle();
    ++r.scene.cameraVersion;
    r.frame(true);
    for (int i = 0; i < 4; ++i)
        EXPECT_TRUE(r.isAll(r.frame(true)));
    r.frame(true);
    EXPECT_FALSE(r.frame(true).lights);
}

TEST(Refresh, CanBeTurnedOff) {
    Refreshed r;
    r.settings.bounce.refresh.lightFrames = 1;
    r.settle();
    for (int i = 0; i < 8; ++i)
        EXPECT_TRUE(r.isAll(r.frame(true)));
}

// A box of 0.1 m in a ball, under a light that lights a cone of 60 degrees to either side.
TEST(Refresh, SharesAreOfDirections) {
    Refreshed r;
    r.frame(true);
    const uint32_t row = uint32_t(r.scene.instances.size()) - 1;
    r.scene.changedInstances = {{row, row + 1}};
    SceneView view{.scene = &r.scene, .draws = &r.draws, .grid = {.size = {160, 90}}};
    view.moved = r.scene.changedInstances;
    const auto ofBall = [](double distance) {
        return 1 - std::cos(std::asin(0.05 * std::sqrt(3) / distance));  // over 2 pi
    };
    const double height = std::tan(glm::radians(35.0)), width = height * 160 / 90;
    // A cone round the picture, of which the picture has the part that it has of the cone's cross-section.
    const double cone = 1 - std::cos(std::atan(std::hypot(width, height)));
    const double part = 4 * width * height / (glm::pi<double>() * (width * width + height * height));
    const double ofPicture = ofBall(std::hypot(1.9, 0.5)) / (cone * part);
    EXPECT_NEAR(shareSeen(worldOf(view, r.lists), r.scene.camera, view.grid.size), ofPicture,
                0.02 * ofPicture);
    r.scene.camera.forward = -r.scene.camera.forward;  // looks away
    const double ofLight = ofBall(3) / (1 - std::cos(glm::radians(60.0)));
    EXPECT_NEAR(shareSeen(worldOf(view, r.lists), r.scene.camera, view.grid.size), ofLight, 0.02 * ofLight);
    r.scene.lights[0].direction = {0, 1, 0};  // and so does the light
    EXPECT_EQ(shareSeen(worldOf(view, r.lists), r.scene.camera, view.grid.size), 0);
}

TEST(Refresh, LightsFollowAThingThatLeavesItsLightBehind) {
    Refreshed fast;
    fast.settle();
    fast.step = 0.02f;  // a radius is 0.087 m: more than half of it in three frames
    fast.frame(true);
    std::vector<bool> lights;
    for (int i = 0; i < 6; ++i)
        lights.push_back(fast.frame(true).lights);
    EXPECT_EQ(lights, (std::vector<bool>{false, false, true, false, false, true}));
    fast.scene.lights[0].direction = {0, 1, 0};  // it reflects nothing now
    fast.frame(true);
    fast.settle();
    lights.clear();
    for (int i = 0; i < 7; ++i)
        lights.push_back(fast.frame(true).lights);
    EXPECT_EQ(lights, (std::vector<bool>{true, false, false, false, false, false, true}));
}

}  // namespace
}  // namespace ag::gi
