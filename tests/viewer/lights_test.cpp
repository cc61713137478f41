// Dragging lights by their handles, and undoing it.
#include <gtest/gtest.h>

#include "tools/viewer/light_handles.h"

namespace ag::viewer {
namespace {

Screen screen() {
    Screen s;
    s.pose.position = {1, 2, 5};
    s.pose.verticalFov = 1;
    s.size = {400, 200};
    return s;
}

TEST(LightHandles, LieWhereTheRendererDrawsTheirPlace) {
    const Screen s = screen();
    RenderScene scene;
    setCamera(scene, s.pose, {400, 200});
    for (const glm::dvec3 place : {glm::dvec3(1, 2, 0), glm::dvec3(1.7, 1.4, -3), glm::dvec3(-2, 3, 1)}) {
        const glm::vec4 clip =
            scene.camera.clipFromWorld * glm::vec4(glm::vec3(place - scene.originWorld), 1);
        const glm::vec2 pixel = (glm::vec2(clip) / clip.w * 0.5f + 0.5f) * s.size;
        ASSERT_TRUE(projected(s, place));
        EXPECT_NEAR(glm::distance(*projected(s, place), pixel), 0, 0.01f);
    }
    EXPECT_FALSE(projected(s, {1, 2, 9})) << "behind the eye";
}

TEST(LightHandles, FollowTheMouse) {
    const Screen s = screen();
    const glm::dvec3 place(1.5, 2.5, -2);
    const glm::dvec3 moved = draggedPlace(s, place, {30, -12});
    EXPECT_NEAR(glm::distance(*projected(s, moved), *projected(s, place) + glm::vec2(30, -12)), 0, 0.01f);
    EXPECT_NEAR(moved.z, place.z, 1e-5) << "in the plane of the picture";
}

TEST(LightHandles, MoveLampsAndTurnSpotsAndSuns) {
    const glm::dvec3 origin(1000, 0, 0), focus(1000, 1, 0);
    std::vector<RenderLight> lights(3);
    lights[0].position = {1, 1, 1};
    lights[1].kind = LightKind::kSpot;
    lights[2].kind = LightKind::kDirectional;
    const auto handles = lightHandles(lights, origin, focus, 2);
    ASSERT_EQ(handles.size(), 4u) << "a lamp's place, a spot's and where it points, a sun's way";
    EXPECT_EQ(handles[0].place, glm::dvec3(1001, 1, 1));

    moveHandle(handles[0], {1002, 3, 1}, origin, lights[0]);
    EXPECT_EQ(lights[0].position, glm::vec3(2, 3, 1));
    moveHandle(handles[2], handles[2].anchor + glm::dvec3(0, 0, -5), origin, lights[1]);
    EXPECT_EQ(lights[1].direction, glm::vec3(0, 0, -1));
    EXPECT_EQ(lights[1].position, glm::vec3(0));
    EXPECT_EQ(handles[3].place, focus + glm::dvec3(0, 2, 0)) << "it shines down from above";
    moveHandle(handles[3], focus + glm::dvec3(3, 0, 0), origin, lights[2]);
    EXPECT_EQ(lights[2].direction, glm::vec3(-1, 0, 0));
    const RenderLight before = lights[2];
    moveHandle(handles[3], focus, origin, lights[2]);
    EXPECT_EQ(lights[2], before) << "no way";
}

TEST(LightHandles, TheNearestIsTaken) {
    const Screen s = screen();
    std::vector<RenderLight> lights(2);
    lights[0].position = {1, 2, 0};
    lights[1].position = {1.1f, 2, 0};
    const auto handles = lightHandles(lights, {0, 0, 0}, {0, 0, 0}, 1);
    const glm::vec2 first = *projected(s, handles[0].place), second = *projected(s, handles[1].place);
    EXPECT_EQ(handleAt(s, handles, glm::mix(first, second, 0.3f)), 0u);
    EXPECT_EQ(handleAt(s, handles, glm::mix(first, second, 0.7f)), 1u);
    EXPECT_FALSE(handleAt(s, handles, first + glm::vec2(0, 40)));
}

}  // namespace
}  // namespace ag::viewer
