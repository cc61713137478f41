// A frame like the one before it allocates nothing on the heap: declaring, planning, uploading, recording,
// submitting. Without validation, whose layers allocate at will; driver threads are not counted, as the count
// is per thread.
#include <gtest/gtest.h>

#include <cstdlib>
#include <new>

#include "engine/scene/static_scene.h"
#include "gi/gi_renderer.h"
#include "tools/scenegen/scenes.h"

namespace {
thread_local bool tCounting = false;
thread_local size_t tAllocations = 0;
}  // namespace

void* operator new(size_t bytes) {
    tAllocations += tCounting;
    if (void* memory = std::malloc(bytes)) return memory;
    throw std::bad_alloc();
}
void operator delete(void* memory) noexcept {
    std::free(memory);
}
void operator delete(void* memory, size_t) noexcept {
    std::free(memory);
}

namespace ag::gi {
namespace {

TEST(SteadyFrame, AllocatesNothingWhileThingsMove) {
    auto device = gpu::Device::create({});
    ASSERT_TRUE(device) << device.error().message;
    const SceneAsset asset = *scenegen::buildScene("gallery", 0);
    RenderScene scene = staticScene(asset);
    const glm::uvec2 size(96, 54);
    GiRenderer renderer(**device);
    renderer.load(asset.geometry);
    const GiSettings settings;
    CameraPose pose = cameraOf(asset, 0);
    uint64_t ran = 0;
    const auto frame = [&](int i) {
        pose.position.x += 0.01;
        setCamera(scene, pose, size);
        scene.lights[0].direction = glm::normalize(glm::vec3(0.3f, -1, 0.01f * float(i)));
        scene.instances.back().worldFromLocal[3].y += 0.001f;
        ++scene.instancesVersion;
        renderer.render(scene, size, settings, {},
                        [](FrameGraph& graph, const SceneView&, const GiFrame& declared) {
                            graph.output(declared.outputs.display);
                        });
        for (const PassReport& pass : renderer.graph().report())
            ran += pass.outcome == PassOutcome::kRan;
    };
    for (int i = 0; i < 12; ++i)
        frame(i);
    ran = 0;
    tAllocations = 0;
    tCounting = true;
    for (int i = 12; i < 24; ++i)
        frame(i);
    tCounting = false;
    EXPECT_GT(ran, 12u * 15u) << "the frames must have had work to do";
    EXPECT_EQ(tAllocations, 0u);
}

}  // namespace
}  // namespace ag::gi
