// A frame like the one before it allocates nothing on the heap: declaring, planning, uploading, recording,
// submitting. Without validation, whose layers allocate at will; driver threads are not counted, as the count
// is per thread.
#include <gtest/gtest.h>

#include "engine/renderer/renderer.h"
#include "engine/scene/static_scene.h"
#include "tests/support/allocation_counter.h"
#include "tools/scenegen/scenes.h"

namespace ag::gi {
using namespace render;
namespace {

void allocatesNothing(const char* name) {
    auto device = gpu::Device::create({});
    ASSERT_TRUE(device) << device.error().message;
    const SceneAsset asset = *scenegen::buildScene(name, 0);
    RenderScene scene = staticScene(asset);
    const glm::uvec2 size(96, 54);
    Renderer renderer(**device);
    renderer.load(asset.geometry);
    scene.instances.back().movable = true;
    const RenderSettings settings;
    CameraPose pose = cameraOf(asset, 0);
    uint64_t ran = 0;
    const auto frame = [&](int i) {
        pose.position.x += 0.01;
        setCamera(scene, pose, size);
        scene.lights[0].direction = glm::normalize(glm::vec3(0.3f, -1, 0.01f * float(i)));
        scene.instances.back().worldFromLocal[3].y += 0.001f;
        ++scene.instancesVersion;
        renderer.render(scene, size, settings, {},
                        [](GraphScope scope, const SceneView&, const RenderFrame& declared) {
                            scope.output(declared.outputs.display);
                        });
        for (const PassReport& pass : renderer.graph().report())
            ran += pass.outcome == PassOutcome::kRan;
    };
    for (int i = 0; i < 12; ++i)
        frame(i);
    ran = 0;
    const size_t allocations = test::countAllocations([&] {
        for (int i = 12; i < 24; ++i)
            frame(i);
    });
    EXPECT_GT(ran, 12u * 15u) << "the frames must have had work to do";
    EXPECT_EQ(allocations, 0u) << name;
}

TEST(SteadyFrame, AllocatesNothingWhileThingsMove) {
    allocatesNothing("hall");
}
TEST(SteadyFrame, AllocatesNothingForSurfacesThatBlend) {
    allocatesNothing("panes");
}

}  // namespace
}  // namespace ag::gi
