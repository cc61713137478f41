// Whole frames with indirect light as work of its own beside direct light: the same bits.
#include <gtest/gtest.h>

#include "engine/renderer/renderer.h"
#include "engine/scene/static_scene.h"
#include "tools/scenegen/scenes.h"

namespace ag::render {
namespace {

struct Frames {
    std::vector<Image> images;
    size_t passes = 0, submissions = 0;
};

// The camera walks, and a thing moves in every other frame.
Frames walk(gpu::AsyncQueue mode, const char* preset) {
    auto device = gpu::Device::create({.validation = true, .asyncQueue = mode});
    EXPECT_TRUE(device) << device.error().message;
    const SceneAsset asset = *scenegen::buildScene("cornell", 0);
    RenderScene scene = staticScene(asset);
    RenderSettings settings;
    EXPECT_TRUE(applyPreset(preset, settings));
    settings.bounce.laterBounces.enabled = settings.technique == Technique::kAreaLights;
    Renderer renderer(**device);
    renderer.load(asset.geometry);
    Frames frames;
    for (uint32_t i = 0; i < 6; ++i) {
        CameraPose pose = cameraOf(asset, 0);
        pose.position.x += 0.02f * float(i);
        setCamera(scene, pose, {96, 54});
        if (i % 2) {
            scene.instances[1].worldFromLocal[3].x += 0.01f;
            scene.changedInstances = {{1, 2}};
            scene.allInstancesChanged = false;
            ++scene.instancesVersion;
        }
        frames.images.push_back(renderLayer(renderer, scene, {96, 54}, settings, Layer::kRadiance, 1));
        frames.passes += renderer.graph().report().size();
        frames.submissions += renderer.submissions();
    }
    return frames;
}

TEST(AsyncFrame, ChangesNoBit) {
    for (const char* preset : {"afterglow", "stochastic", "ssvp"}) {
        const Frames plain = walk(gpu::AsyncQueue::kOff, preset),
                     split = walk(gpu::AsyncQueue::kAlone, preset);
        EXPECT_EQ(plain.passes, split.passes);
        EXPECT_EQ(plain.submissions, plain.images.size());
        EXPECT_GT(split.submissions, 2 * split.images.size()) << preset;
        std::printf("%s: %zu submissions in %zu frames\n", preset, split.submissions, split.images.size());
        for (size_t i = 0; i < plain.images.size(); ++i)
            EXPECT_EQ(plain.images[i].pixels, split.images[i].pixels) << preset << " frame " << i;
    }
}

}  // namespace
}  // namespace ag::render
