// Texels seen along traced rays, over geometry whose answer is known.
#include "tools/bench/texel_rays.h"

#include <gtest/gtest.h>

#include "engine/scene/static_scene.h"
#include "tools/scenegen/builder.h"

namespace ag::bench {
namespace {

constexpr float kPi = 3.14159265f;

// A square of 1 m under the ceiling that shines down in n x n texels, the left half twice as strong.
AreaLightSet square(uint32_t n) {
    AreaLightSet set;
    set.lights.push_back({.texelCount = n * n, .reach = 0.7f});
    float sum = 0;
    for (uint32_t i = 0; i < n * n; ++i) {
        const float x = (float(i % n) + 0.5f) / float(n) - 0.5f, z = (float(i / n) + 0.5f) / float(n) - 0.5f;
        const float flux = (x < 0 ? 2.0f : 1.0f) / float(n * n);
        set.texels.push_back({.position = {x, 2, z},
                              .area = 1.0f / float(n * n),
                              .normal = {0, -1, 0},
                              .weight = flux,
                              .flux = glm::vec3(flux),
                              .emitterCosine = 1});
        set.weightUpTo.push_back(sum += flux);
    }
    return set;
}

// A floor, and half way up a board that hides the square's right half from its middle.
struct Room {
    explicit Room(bool board) {
        scenegen::SceneBuilder b("room");
        const uint32_t gray = b.material("gray", glm::vec3(0.5f));
        b.quad("floor", {-2, 0, 2}, {4, 0, 0}, {0, 0, -4}, gray);
        if (board) b.box("board", {1, 1, 0}, {2, 0.02f, 4}, gray);
        b.camera("camera", {0, 1, 1}, {0, 0, 0}, 50);
        asset = b.finish();
        scene = staticScene(asset);
    }
    reference::Surface floorAt(const reference::RayScene& rays, glm::vec3 place) const {
        reference::Surface s;
        EXPECT_TRUE(rays.intersect(place + glm::vec3(0, 0.5f, 0), {0, -1, 0}, s));
        rays.resolve(s);
        return s;
    }
    SceneAsset asset;
    RenderScene scene;
};

TEST(TexelRays, AllAddUpToTheSquare) {
    const Room room(false);
    const reference::RayScene rays(room.scene);
    const AreaLightSet set = square(32);
    const reference::Surface at = room.floorAt(rays, {0, 0, 0});
    TexelRays texels(rays, set, at);
    const TexelSum sum = texels.all(set.lights[0]);
    // A square of half side a seen from below its middle at height h: 4/pi c atan(c) with c = a / sqrt(a² +
    // h²).
    const float c = 0.5f / std::sqrt(0.25f + 4.0f);
    EXPECT_NEAR(sum.irradiance.x / (1.5f * 4 / kPi * c * std::atan(c)), 1, 0.002) << "1.5 W from 1 m²";
    EXPECT_FLOAT_EQ(sum.seen, 1);
    EXPECT_EQ(texels.rays(), 1024u);
    EXPECT_TRUE(texels.sees({0, 2, 0}));
}

TEST(TexelRays, ABoardHidesHalf) {
    const Room room(true);
    const reference::RayScene rays(room.scene);
    const AreaLightSet set = square(32);
    const reference::Surface at = room.floorAt(rays, {-0.001f, 0, 0});
    TexelRays texels(rays, set, at);
    const TexelSum sum = texels.all(set.lights[0]);
    EXPECT_NEAR(sum.seen, 2.0f / 3, 0.002f) << "the stronger half";
    EXPECT_TRUE(texels.sees({-0.2f, 2, 0}));
    EXPECT_FALSE(texels.sees({0.2f, 2, 0}));
}

TEST(TexelRays, SomeAreAllInTheMean) {
    const Room room(true);
    const reference::RayScene rays(room.scene);
    const AreaLightSet set = square(32);
    const reference::Surface at = room.floorAt(rays, {0.3f, 0, 0.2f});
    TexelRays texels(rays, set, at);
    const float truth = texels.all(set.lights[0]).irradiance.x;
    double sum = 0;
    constexpr uint32_t kSeeds = 4000;
    for (uint32_t seed = 0; seed < kSeeds; ++seed)
        sum += double(texels.some(set.lights[0], 4, seed).irradiance.x) / kSeeds;
    EXPECT_NEAR(sum / double(truth), 1, 0.01);
}

}  // namespace
}  // namespace ag::bench
