// Skies, emissive surfaces and jittered cameras through the C functions, against closed forms: a black floor
// below a black plate that moves.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "engine/scene/static_scene.h"
#include "tests/guest/guest_host.h"

namespace ag::test {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;
constexpr glm::uvec2 kPixels{24, 24};
constexpr float kEyes = 0.6f;                   // m over the floor, below the plate
constexpr glm::vec3 kPlate{4, 0.11f, 3.6f};     // m, its lower side 1 m over the floor
constexpr float kBelow = 0.8148f, kShines = 2;  // form factor of the plate's lower side; W/(m² sr)

// The room's box is 1 m x 1.1 m x 0.9 m.
AgiInstance slab(uint64_t id, uint32_t mesh, glm::vec3 size, glm::dvec3 lowerMiddle, bool movable) {
    AgiInstance instance{AGI_INIT(AgiInstance)};
    instance.id = id;
    instance.mesh = mesh;
    instance.movable = movable;
    const glm::vec3 scale = size / glm::vec3(1, 1.1f, 0.9f);
    const glm::dvec3 at = lowerMiddle - glm::dvec3(scale) * glm::dvec3(-0.4, 0, -0.95);
    for (int c = 0; c < 3; ++c) {
        instance.linear[4 * c] = scale[c];
        instance.position[c] = at[c];
    }
    return instance;
}

// Looks straight down at the floor's middle.
HostCamera lookingDown() {
    RenderScene scene;
    setCamera(scene,
              {.position = {0, kEyes, 0}, .forward = {0, -1, 0}, .up = {0, 0, -1}, .verticalFov = 0.2f},
              kPixels);
    Image depth(int(kPixels.x), int(kPixels.y)), normal(int(kPixels.x), int(kPixels.y));
    std::ranges::fill(depth.pixels, glm::vec3(kEyes));
    std::ranges::fill(normal.pixels, glm::vec3(0, 1, 0));
    return HostCamera(scene.camera, scene.originWorld, depth, normal);
}

class Slabs : public testing::Test {
  protected:
    Slabs() {
        AgiMaterial materials[2] = {{AGI_INIT(AgiMaterial)}, {AGI_INIT(AgiMaterial)}};
        uint32_t first = 0;
        EXPECT_EQ(agiAddMaterials(guest_.scene, 2, materials, &first), AGI_OK);
        for (const uint32_t material : {0u, 1u}) {
            AgiMesh box = room_.meshes()[1];
            box.material = material;
            EXPECT_EQ(agiAddMeshes(guest_.scene, 1, &box, &first), AGI_OK) << agiLastError();
        }
        const AgiInstance floor = slab(1, 0, {40, 1, 40}, {0, -1, 0}, false);
        EXPECT_EQ(agiSetInstances(guest_.scene, 1, &floor), AGI_OK) << agiLastError();
        movePlate(0);
    }
    void movePlate(double x) {
        const AgiInstance plate = slab(2, 1, kPlate, {x, 1, 0}, true);
        EXPECT_EQ(agiSetInstances(guest_.scene, 1, &plate), AGI_OK) << agiLastError();
    }
    void shine(float radiance) {
        AgiMaterial material{AGI_INIT(AgiMaterial)};
        for (float& channel : material.emissive)
            channel = radiance;
        EXPECT_EQ(agiUpdateMaterials(guest_.scene, 1, 1, &material), AGI_OK) << agiLastError();
    }
    double light() const { return meanOf(camera_.irradiance()); }
    float settled() const {
        AgiStatus status{AGI_INIT(AgiStatus)};
        EXPECT_EQ(agiGetStatus(view_, &status), AGI_OK);
        return status.settled;
    }

    HostRoom room_;
    HostCamera camera_ = lookingDown();
    Guest guest_;
    AgiView view_ = guest_.addView(camera_, "medium");  // low casts no rays to lights
};

TEST_F(Slabs, TheSkyIsHiddenByWhatMoves) {
    const float white[3] = {1, 1, 1};
    AgiSky sky{AGI_INIT(AgiSky)};
    sky.width = sky.height = 1;
    sky.radiance = white;
    ASSERT_EQ(agiSetSky(guest_.scene, &sky), AGI_OK) << agiLastError();
    guest_.drawFrames(96, view_, camera_);
    EXPECT_NEAR(light() / double(kPi * (1 - kBelow)), 1, 0.05);
    movePlate(30);
    guest_.drawFrames(48, view_, camera_);
    EXPECT_NEAR(light() / double(kPi), 1, 0.03);
    ASSERT_EQ(agiSetSky(guest_.scene, nullptr), AGI_OK);
    guest_.drawFrames(1, view_, camera_);
    EXPECT_EQ(light(), 0) << "none is left";
}

// A picture that is bright from +X alone, turned so that this comes from above.
TEST_F(Slabs, TheSkysPictureIsTurned) {
    constexpr uint32_t kWidth = 64, kHeight = 32;
    std::vector<float> radiance(3 * kWidth * kHeight, 0);
    for (uint32_t y = 12; y < 20; ++y)
        for (uint32_t x = 28; x < 36; ++x)
            for (uint32_t c = 0; c < 3; ++c)
                radiance[3 * (y * kWidth + x) + c] = 1;
    AgiSky sky{AGI_INIT(AgiSky)};
    sky.width = kWidth;
    sky.height = kHeight;
    sky.radiance = radiance.data();
    ASSERT_EQ(agiSetSky(guest_.scene, &sky), AGI_OK) << agiLastError();
    movePlate(30);
    guest_.drawFrames(32, view_, camera_);
    const double aside = light();
    const float up[9] = {0, 1, 0, -1, 0, 0, 0, 0, 1};  // +X to +Y
    std::ranges::copy(up, sky.worldFromPicture);
    ASSERT_EQ(agiSetSky(guest_.scene, &sky), AGI_OK) << agiLastError();
    guest_.drawFrames(32, view_, camera_);
    // 45° by 45° about the middle: the integral of the cosine to it, by its texels.
    double above = 0;
    for (int y = -40; y < 40; ++y)
        for (int x = -40; x < 40; ++x) {
            const double up45 = (y + 0.5) * std::numbers::pi / 320,
                         round = (x + 0.5) * std::numbers::pi / 320;
            above += std::cos(up45) * std::cos(up45) * std::cos(round) * std::pow(std::numbers::pi / 320, 2);
        }
    EXPECT_NEAR(light() / above, 1, 0.05);
    EXPECT_LT(aside, 0.4 * above);
}

TEST_F(Slabs, WhatIsEmissiveShinesAndMoves) {
    shine(kShines);
    guest_.drawFrames(48, view_, camera_);
    EXPECT_NEAR(light() / double(kPi * kBelow * kShines), 1, 0.05);
    movePlate(30);
    guest_.drawFrames(4, view_, camera_);
    EXPECT_LT(light(), 0.02);
    movePlate(0);
    shine(0);
    guest_.drawFrames(1, view_, camera_);
    EXPECT_EQ(light(), 0);
}

// Rays are cast while nothing changes, however an anti-aliased camera is shaken.
TEST_F(Slabs, AJitteredCameraStandsStill) {
    shine(kShines);
    int frame = 0;
    bool told = true;
    guest_.change = [&](AgiFrame& f) {
        const float jitter[2] = {float(frame % 3 - 1) / float(kPixels.x),
                                 float(frame % 2) / float(kPixels.y)};
        for (int axis = 0; axis < 2; ++axis) {
            f.clipFromView[8 + axis] += jitter[axis] * f.clipFromView[11];
            if (told) f.jitter[axis] = jitter[axis];
        }
        ++frame;
    };
    guest_.drawFrames(40, view_, camera_);
    const float steady = settled();
    EXPECT_NEAR(light() / double(kPi * kBelow * kShines), 1, 0.05);
    told = false;
    guest_.drawFrames(40, view_, camera_);
    EXPECT_LT(settled(), steady);
}

TEST_F(Slabs, WhatCannotBeIsRefused) {
    const float good[3] = {1, 1, 1}, bad[3] = {1, -1, std::numeric_limits<float>::quiet_NaN()};
    const auto refused = [&](auto&& spoil) {
        AgiSky sky{AGI_INIT(AgiSky)};
        sky.width = sky.height = 1;
        sky.radiance = good;
        spoil(sky);
        EXPECT_EQ(agiSetSky(guest_.scene, &sky), AGI_ERROR_ARGUMENT);
        EXPECT_NE(std::string(agiLastError()), "");
    };
    refused([](AgiSky& s) { s.structSize = 0; });
    refused([](AgiSky& s) { s.radiance = nullptr; });
    refused([](AgiSky& s) { s.width = 0; });
    refused([](AgiSky& s) { s.width = 3; });
    refused([](AgiSky& s) { s.width = 1u << 20, s.height = 1u << 19; });
    refused([&](AgiSky& s) { s.radiance = bad; });
    refused([](AgiSky& s) { s.worldFromPicture[0] = 2; });
    EXPECT_EQ(agiSetSky(nullptr, nullptr), AGI_ERROR_ARGUMENT);
    AgiMaterial material{AGI_INIT(AgiMaterial)};
    material.emissive[1] = -1;
    EXPECT_EQ(agiUpdateMaterials(guest_.scene, 1, 1, &material), AGI_ERROR_ARGUMENT);
    guest_.drawFrames(1, view_, camera_);
    EXPECT_EQ(light(), 0) << "nothing was changed";
}

}  // namespace
}  // namespace ag::test
