// Suns' shadow maps in two layers.
#include <gtest/gtest.h>

#include "tests/gi_gpu/bench.h"
#include "tools/scenegen/builder.h"

namespace ag::gi {
using namespace render;
namespace {

std::unique_ptr<Bench> courtWithSun() {
    scenegen::SceneBuilder court("court");
    const uint32_t white = court.material("white", glm::vec3(0.7f));
    court.box("ground", {0, -0.5f, 0}, {8, 1, 8}, white);
    court.box("wall", {-1, 1, -1}, {0.4f, 2, 3}, white);
    court.box("fence", {1, 0.5f, -1}, {0.1f, 1, 2}, court.material("fence", glm::vec3(0.5f)));
    court.box("ball", {0, 1, 0}, glm::vec3(0.3f), court.material("ball", glm::vec3(0.4f)));
    court.camera("camera", {2, 2, 3}, {0, 0.5f, 0}, 60);
    SceneAsset asset = court.finish();
    for (Material& material : asset.geometry.materials)
        if (material.name != "white") material.alphaMode = AlphaMode::kMask;
    auto b = std::make_unique<Bench>(std::move(asset));
    b->scene.lights.push_back({.kind = LightKind::kDirectional,
                               .direction = glm::normalize(glm::vec3(0.4f, -1, 0.3f)),
                               .intensity = glm::vec3(3),
                               .id = 7});
    b->scene.instances.back().movable = true;
    b->output = [](GraphScope scope, const RenderFrame& f) {
        if (f.shadows.atlas) scope.output(f.shadows.atlas);
    };
    return b;
}

void moveBall(Bench& b, int frames) {
    const uint32_t row = uint32_t(b.scene.instances.size()) - 1;
    for (int i = 0; i < frames; ++i) {
        b.scene.instances.back().worldFromLocal[3].x += 0.05f;
        b.scene.changedInstances = {{row, row + 1}};
        b.scene.allInstancesChanged = b.renderer.graph().frame() == 0;
        ++b.scene.instancesVersion;
        b.frame();
    }
}

std::vector<std::byte> depthsOf(Bench& b) {
    const gpu::Image& atlas = b.renderer.graph().physical(b.last.shadows.atlas);
    std::vector<std::byte> bytes(size_t(atlas.desc().size.x) * atlas.desc().size.y * 4);
    b.renderer.waitIdle();
    gpu::downloadImage(b.renderer.device(), atlas, b.renderer.graph().layoutAfterFrame(b.last.shadows.atlas),
                       bytes);
    return bytes;
}

TEST(SunShadows, ThingsThatMoveAreDrawnOverWhatStandsStill) {
    const auto layered = courtWithSun();
    layered->frame();
    EXPECT_EQ(layered->outcome("shadow_maps.cascades"), PassOutcome::kRan);
    moveBall(*layered, 1);
    EXPECT_EQ(layered->outcome("shadow_maps.static"), PassOutcome::kRan);
    moveBall(*layered, 3);
    EXPECT_EQ(layered->outcome("shadow_maps.static"), PassOutcome::kSkipped);
    EXPECT_EQ(layered->outcome("shadow_maps.static_masked"), PassOutcome::kSkipped);
    EXPECT_EQ(layered->outcome("shadow_maps.movable_masked"), PassOutcome::kRan);
    const auto whole = courtWithSun();
    whole->scene.instances = layered->scene.instances;
    whole->frame();
    EXPECT_EQ(whole->outcome("shadow_maps.cascades"), PassOutcome::kRan);
    EXPECT_EQ(depthsOf(*layered), depthsOf(*whole));
}

TEST(SunShadows, WithoutChangesNothingIsDrawnInEitherWay) {
    const auto b = courtWithSun();
    b->frame();
    b->scene.allInstancesChanged = false;
    for (const int moves : {0, 2}) {
        moveBall(*b, moves);
        b->scene.changedInstances.clear();
        b->frame();
        for (const PassReport& pass : b->renderer.graph().report()) {
            const bool shadows = pass.name.starts_with("shadow_maps.");
            EXPECT_FALSE(shadows && pass.outcome == PassOutcome::kRan) << pass.name;
        }
    }
    CameraPose pose = cameraOf(b->asset, 0);
    pose.position.x += 0.3;
    setCamera(b->scene, pose, b->size);
    b->frame();
    EXPECT_EQ(b->outcome("shadow_maps.cascades"), PassOutcome::kRan) << "a layer would not last";
}

}  // namespace
}  // namespace ag::gi
