// Units of a scene: ordinary ones stay, others come near one, and nothing is rounded.
#include "engine/renderer/render_units.h"

#include <gtest/gtest.h>

namespace ag::gi {
using namespace render;
namespace {

RenderScene sceneOf(float diagonal, float irradiance) {
    RenderScene scene;
    scene.bounds = {glm::vec3(0), glm::vec3(diagonal, 0, 0)};
    scene.lights = {{.kind = LightKind::kDirectional, .intensity = glm::vec3(irradiance)},
                    {.kind = LightKind::kPoint, .position = {0.3f, 0, 0}, .intensity = glm::vec3(0)}};
    scene.instances = {{}};
    return scene;
}

TEST(RenderUnits, OrdinaryScenesStayInMetresAndWatts) {
    for (const float diagonal : {0.5f, 3.0f, 200.0f})
        for (const float irradiance : {0.01f, 1.0f, 200.0f})
            EXPECT_EQ(render::chooseUnits(sceneOf(diagonal, irradiance), 0, {}), RenderUnits{});
    EXPECT_EQ(render::chooseUnits(sceneOf(3, 0), 0, {1, 32}).light, 32) << "without light the unit stays";
}

TEST(RenderUnits, OthersComeNearOne) {
    for (const float factor : {1e-6f, 1e-3f, 1e4f, 1e6f}) {
        const RenderScene scene = sceneOf(8 * factor, factor);
        const RenderUnits units = render::chooseUnits(scene, 0, {});
        EXPECT_LT(std::abs(std::log2(factor / units.length)), 3);
        EXPECT_LT(std::abs(std::log2(factor / units.light)), 3);
        EXPECT_EQ(render::chooseUnits(scene, 0, units), units);
    }
    EXPECT_GT(render::chooseUnits(sceneOf(8, 1), 1e6f, {}).light, 1e5f) << "what emits counts, too";
}

TEST(RenderUnits, ConversionIsExactAndLeavesTheImageWhereItIs) {
    RenderScene scene = sceneOf(3000, 5);
    scene.lights[1].intensity = glm::vec3(7, 8, 9);
    scene.instances[0].worldFromLocal[3] = {0.1f, 0.2f, 0.3f};
    scene.camera.clipFromWorld = glm::mat4(1, 0, 0, 0, 0, 2, 0, 0, 0, 0, 0, -1, 0.7f, 0.3f, 0.05f, 4);
    scene.camera.worldFromClip = glm::inverse(scene.camera.clipFromWorld);
    RenderScene out;
    inUnits(scene, {1024, 32}, 1, out);
    EXPECT_EQ(out.instances[0].worldFromLocal[3] * 1024.0f, scene.instances[0].worldFromLocal[3]);
    EXPECT_EQ(out.lights[0].intensity * 32.0f, scene.lights[0].intensity);
    EXPECT_EQ(out.lights[1].intensity * (32.0f * 1024 * 1024), scene.lights[1].intensity);
    EXPECT_GT(out.instancesVersion, scene.instancesVersion);
    const glm::vec4 p(10, -20, 30, 1), q(10 / 1024.0f, -20 / 1024.0f, 30 / 1024.0f, 1);
    const glm::vec4 a = scene.camera.clipFromWorld * p, b = out.camera.clipFromWorld * q;
    EXPECT_EQ(glm::vec3(a) / a.w, glm::vec3(b) / b.w);
    const glm::vec4 back = out.camera.worldFromClip * b;
    EXPECT_NEAR(back.y / back.w, q.y, 1e-6f);
}

// Row by row as from the beginning: what changed, came and went.
TEST(RenderUnits, ConversionOfWhatChangedIsThatOfAll) {
    RenderScene scene = sceneOf(3000, 5), out;
    scene.instances.resize(50);
    const RenderUnits units{1024, 32};
    inUnits(scene, units, 1, out);
    scene.allInstancesChanged = false;
    for (uint32_t turn = 0; turn < 6; ++turn) {
        const uint32_t row = 7 * turn;
        scene.instances[row].worldFromLocal[3] = glm::vec3(float(turn), 2, 3);
        scene.instances[row].primitive = turn % 2 ? kNoPrimitive : 3;
        if (turn == 4) scene.instances.emplace_back();
        scene.changedInstances = {{row, row + 1}};
        if (turn == 4) scene.changedInstances.push_back({50, 51});
        scene.instancesVersion += turn == 5 ? 2 : 1;  // a frame that nobody saw
        if (turn == 5) scene.instances[1].worldFromLocal[3].x = 9;
        RenderScene anew;
        inUnits(scene, units, 1, out);
        inUnits(scene, units, 1, anew);
        ASSERT_EQ(out.instances.size(), anew.instances.size());
        for (size_t i = 0; i < out.instances.size(); ++i) {
            EXPECT_EQ(out.instances[i].worldFromLocal, anew.instances[i].worldFromLocal) << i;
            EXPECT_EQ(out.instances[i].primitive, anew.instances[i].primitive) << i;
        }
        EXPECT_EQ(out.instancesVersion, anew.instancesVersion);
    }
}

}  // namespace
}  // namespace ag::gi
