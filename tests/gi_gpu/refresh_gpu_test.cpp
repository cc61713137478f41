// What is late is as it would have been, only later.
#include <gtest/gtest.h>

#include "tests/gi_gpu/bench.h"
#include "tools/scenegen/builder.h"

namespace ag::gi {
using namespace render;
namespace {

// A box that shines a little moves before the camera, above the light's beam.
std::unique_ptr<Bench> roomWithBox(uint32_t pixelFrames) {
    scenegen::SceneBuilder room("room");
    const uint32_t white = room.material("white", glm::vec3(0.7f));
    const uint32_t glossy = room.material("glossy", glm::vec3(0.5f));
    room.room("walls", {-1, 0, -1}, {1, 2, 1}, {white, white, white, white, white, white});
    room.box("box", {0.3f, 1.1f, -0.6f}, glm::vec3(0.3f), glossy);
    room.spot("lamp", {0, 1, 0}, {0, -1, 0}, glm::vec3(10), {40, 60});
    room.camera("camera", {-0.9f, 1.5f, 0.9f}, {0, 0.8f, 0}, 70);
    SceneAsset asset = room.finish();
    asset.geometry.materials[glossy].specular = 1;
    asset.geometry.materials[glossy].roughness = 0.4f;
    auto b = std::make_unique<Bench>(std::move(asset));
    b->settings.bounce.refresh = {.lightFrames = 40, .pixelFrames = pixelFrames, .small = 1};
    b->settings.bounce.valClustering.settleFrames = 8;
    b->settings.bounce.valClustering.count = 32;
    b->scene.instances.back().movable = true;
    return b;
}

void frame(Bench& b, float step) {
    b.scene.instances.back().worldFromLocal[3].x += step;
    b.scene.changedInstances.clear();
    const uint32_t row = uint32_t(b.scene.instances.size()) - 1;
    if (step != 0) b.scene.changedInstances = {{row, row + 1}};
    if (step != 0) ++b.scene.instancesVersion;
    b.frame();
    b.scene.allInstancesChanged = false;
}

struct Difference {
    size_t indirect = 0, anywhere = 0;  // pixels
};

Difference difference(Bench& a, Bench& b) {
    const auto count = [&](ImageHandle x, ImageHandle y) {
        const Image one = readImage(a.renderer, x), other = readImage(b.renderer, y);
        size_t differ = 0;
        for (size_t i = 0; i < one.pixels.size(); ++i)
            differ += one.pixels[i] != other.pixels[i];
        return differ;
    };
    return {count(a.last.bounce.bounce1.image, b.last.bounce.bounce1.image),
            count(a.last.outputs.radiance, b.last.outputs.radiance)};
}

TEST(Refresh, PixelsAreWhatTheyWouldBeWhenAllHadTheirTurn) {
    const auto some = roomWithBox(4), all = roomWithBox(1);
    for (Bench* b : {some.get(), all.get()})
        b->settings.bounce.texelRays.movingLength = 0;  // rays of other frames find other things
    const auto both = [&](float step) {
        frame(*some, step);
        frame(*all, step);
    };
    for (int i = 0; i < 12; ++i)
        both(0);
    size_t late = 0;
    for (int i = 0; i < 9; ++i) {
        both(0.02f);
        late = std::max(late, difference(*some, *all).indirect);
        const RenderFrame& f = some->last;
        EXPECT_EQ(some->outcome("val_shading.list"), PassOutcome::kRan);
        EXPECT_EQ(some->outcome("val_clustering.assign"), i == 0 ? PassOutcome::kRan : PassOutcome::kSkipped);
        EXPECT_TRUE(f.bounce.gloss);
    }
    std::printf("pixels that are late: %zu of %u\n", late, some->size.x * some->size.y);
    EXPECT_GT(late, 100u) << "else nothing is tested";
    for (int i = 0; i < 3; ++i)
        both(0);
    const Difference now = difference(*some, *all);
    EXPECT_EQ(now.indirect, 0u);
    EXPECT_EQ(now.anywhere, 0u);
}

// The surface of what moves is gathered in every frame: where only it is seen nothing is late.
TEST(Refresh, WhatMovesIsNeverLateItself) {
    const auto some = roomWithBox(16), all = roomWithBox(1);
    for (Bench* b : {some.get(), all.get()}) {
        b->settings.bounce.spacing = 1;
        for (int i = 0; i < 12; ++i)
            frame(*b, 0);
    }
    size_t box = 0;
    for (int i = 0; i < 6; ++i) {
        for (Bench* b : {some.get(), all.get()})
            frame(*b, 0.02f);
        const Image a = readImage(some->renderer, some->last.bounce.bounce1.image),
                    b = readImage(all->renderer, all->last.bounce.bounce1.image),
                    albedo = readImage(all->renderer, all->last.gbuffer.surfaces.albedo);
        for (size_t p = 0; p < a.pixels.size(); ++p) {
            if (albedo.pixels[p].x < 0.4f || albedo.pixels[p].x > 0.6f) continue;  // a wall
            ++box;
            EXPECT_EQ(a.pixels[p], b.pixels[p]);
        }
    }
    EXPECT_GT(box, 100u);
}

}  // namespace
}  // namespace ag::gi
