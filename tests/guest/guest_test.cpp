// A stranger's renderer lit by the library: what it brings, and what must not matter.
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <thread>

#include "tests/guest/guest_host.h"

namespace ag::test {
namespace {

constexpr int kFrames = 24;

std::vector<glm::vec3> lightOf(const GbufferLayout& layout, int frames = kFrames) {
    const HostRoom room;
    const HostCamera camera(room.room(), layout);
    Guest guest(room);
    guest.drawFrames(frames, guest.addView(camera), camera);
    return camera.irradiance();
}

// Whether the pass ran in the frame drawn last.
bool ran(AgiView view, std::string_view name) {
    uint32_t count = 0;
    EXPECT_EQ(agiGetPasses(view, &count, nullptr), AGI_OK);
    std::vector<AgiPass> passes(count);
    EXPECT_EQ(agiGetPasses(view, &count, passes.data()), AGI_OK);
    for (const AgiPass& pass : passes)
        if (pass.name == name) return pass.ran != 0;
    ADD_FAILURE() << "there is no pass " << name;
    return false;
}

TEST(Guest, EveryGbufferLayoutGivesTheSameLight) {
    const auto expected = lightOf({});
    EXPECT_GT(meanOf(expected), 0.01);
    const GbufferLayout others[] = {
        {.reversedDepth = false, .farPlane = true, .normals = AGI_NORMAL_XYZ_SIGNED},
        {.reversedDepth = true, .farPlane = true, .normals = AGI_NORMAL_XYZ_UNSIGNED},
        {.reversedDepth = false, .farPlane = false, .normals = AGI_NORMAL_OCTAHEDRAL_UNSIGNED}};
    for (const GbufferLayout& layout : others) {
        const auto light = lightOf(layout);
        EXPECT_NEAR(meanOf(light) / meanOf(expected), 1, 0.005) << "normals " << int(layout.normals);
        EXPECT_LT(relativeError(light, expected), 0.02) << "normals " << int(layout.normals);
    }
}

TEST(Guest, TwoViewsOfOneContextDoNotDisturbEachOther) {
    const auto alone = lightOf({});
    const HostRoom room;
    const HostCamera one(room.room(), {}), other(room.room(), {.size = {64, 36}, .reversedDepth = false});
    Guest guest(room);
    const AgiView first = guest.addView(one), second = guest.addView(other, "high");
    for (int i = 0; i < kFrames; ++i)
        guest.drawFrame({{first, &one}, {second, &other}});
    EXPECT_TRUE(one.irradiance() == alone) << relativeError(one.irradiance(), alone);
    EXPECT_NEAR(meanOf(other.irradiance()) / meanOf(alone), 1, 0.1);
}

TEST(Guest, TwoContextsOfOneDeviceDoNotDisturbEachOther) {
    const auto alone = lightOf({}, 8);
    const HostRoom room;
    const HostCamera one(room.room(), {}), other(room.room(), {});
    Guest first(room), second(room);
    const AgiView view = first.addView(one), same = second.addView(other);
    for (int i = 0; i < 8; ++i) {
        first.drawFrame({{view, &one}});
        second.drawFrame({{same, &other}});
    }
    EXPECT_TRUE(one.irradiance() == alone) << relativeError(one.irradiance(), alone);
    EXPECT_TRUE(other.irradiance() == alone) << relativeError(other.irradiance(), alone);
}

TEST(Guest, AnotherThreadPreparesAndRecords) {
    const auto expected = lightOf({}, 4);
    const HostRoom room;
    const HostCamera camera(room.room(), {});
    Guest guest(room);
    const AgiView view = guest.addView(camera);
    std::thread([&] { EXPECT_EQ(agiPrepare(view, guest.scene), AGI_OK) << agiLastError(); }).join();
    std::thread([&] { guest.drawFrames(4, view, camera); }).join();
    EXPECT_TRUE(camera.irradiance() == expected) << relativeError(camera.irradiance(), expected);
}

TEST(Guest, ARoomFarFromTheOriginIsLitTheSame) {
    const auto expected = lightOf({});
    const glm::dvec3 place(3e6, -2e6, 1e6);
    const HostRoom room;
    const HostCamera camera(room.room(), {}, place);
    Guest guest(room, {}, place);
    guest.drawFrames(kFrames, guest.addView(camera), camera);
    EXPECT_LT(relativeError(camera.irradiance(), expected), 0.01);
}

// Coordinates are about a place near the camera: trees that stand still follow it, whatever else moves.
TEST(Guest, ALongWayBesideAMovingThingIsLitTheSame) {
    const glm::dvec3 there(2000, 0, 0);
    const HostRoom room;
    const HostCamera here(room.room(), {}), camera(room.room(), {}, there), fresh(room.room(), {}, there);
    const auto walk = [&](const HostCamera& end, bool travels) {
        Guest guest(room, {}, there);
        const AgiView view = guest.addView(end, "medium");
        AgiInstance box = room.instances(there)[1];
        box.movable = 1;
        const double stands = box.position[2];
        for (int left = travels ? 44 : 24; left > 0; --left) {
            box.position[2] = stands + 0.001 * left;
            EXPECT_EQ(agiSetInstances(guest.scene, 1, &box), AGI_OK);
            guest.drawFrame({{view, left > 24 ? &here : &end}});
        }
        return end.irradiance();
    };
    const auto travelled = walk(camera, true), stayed = walk(fresh, false);
    EXPECT_NEAR(meanOf(travelled) / meanOf(stayed), 1, 0.03);
    EXPECT_LT(relativeError(travelled, stayed), 0.15);
}

TEST(Guest, GlossIsWhatAMetalReflects) {
    const HostRoom room;
    const HostCamera camera(room.room(), {.gloss = true});
    Guest guest(room);
    guest.drawFrames(kFrames, guest.addView(camera), camera);
    const double gloss = meanOf(camera.gloss()), diffuse = meanOf(camera.irradiance()) / 3.14159;
    // A rough metal's mean is near its reflectance times the mean light: of the same order, and not more.
    EXPECT_GT(gloss, 0.2 * diffuse);
    EXPECT_LT(gloss, 1.5 * diffuse);
}

TEST(Guest, WithoutLightItIsBlackAtOnceAndLightComesBack) {
    const HostRoom room;
    const HostCamera camera(room.room(), {});
    Guest guest(room);
    const AgiView view = guest.addView(camera);
    guest.drawFrames(8, view, camera);
    EXPECT_GT(meanOf(camera.irradiance()), 0.01);
    ASSERT_EQ(agiSetLights(guest.scene, 0, nullptr), AGI_OK);
    guest.drawFrames(1, view, camera);
    EXPECT_EQ(meanOf(camera.irradiance()), 0);
    const AgiLight light = spotAt({});
    ASSERT_EQ(agiSetLights(guest.scene, 1, &light), AGI_OK);
    guest.drawFrames(8, view, camera);
    EXPECT_GT(meanOf(camera.irradiance()), 0.01);
}

TEST(Guest, AnotherSceneKnowsNothingOfTheLightBefore) {
    const HostRoom room;
    const HostCamera camera(room.room(), {}), fresh(room.room(), {});
    Guest guest(room);
    const AgiView view = guest.addView(camera);
    guest.drawFrames(12, view, camera);
    AgiScene dim = nullptr;
    ASSERT_EQ(agiCreateScene(guest.context, &dim), AGI_OK);
    ASSERT_EQ(room.fill(dim), AGI_OK);
    AgiLight light = spotAt({});
    for (float& channel : light.intensity)
        channel = 1;
    ASSERT_EQ(agiSetLights(dim, 1, &light), AGI_OK);
    std::swap(guest.scene, dim);
    guest.drawFrames(1, view, camera);
    // As bright in its first frame as a scene that nobody drew before, or less.
    Guest other(room);
    ASSERT_EQ(agiSetLights(other.scene, 1, &light), AGI_OK);
    other.drawFrames(1, other.addView(fresh), fresh);
    EXPECT_NEAR(meanOf(camera.irradiance()) / meanOf(fresh.irradiance()), 1, 0.05);
    agiDestroyScene(dim);
}

// The allocator likes to give the next scene the place of the last.
TEST(Guest, ASceneInThePlaceOfADestroyedOneIsAnother) {
    const HostRoom room;
    const HostCamera camera(room.room(), {}), fresh(room.room(), {});
    Guest guest(room);
    const AgiView view = guest.addView(camera);
    guest.drawFrames(4, view, camera);
    const AgiLight light = spotAt({0.5, 0, 0});
    agiDestroyScene(guest.scene);
    ASSERT_EQ(agiCreateScene(guest.context, &guest.scene), AGI_OK);
    ASSERT_EQ(room.fill(guest.scene), AGI_OK);
    ASSERT_EQ(agiSetLights(guest.scene, 1, &light), AGI_OK);
    guest.drawFrames(8, view, camera);
    Guest other(room);
    ASSERT_EQ(agiSetLights(other.scene, 1, &light), AGI_OK);
    other.drawFrames(8, other.addView(fresh), fresh);
    EXPECT_LT(relativeError(camera.irradiance(), fresh.irradiance()), 0.05);
}

// Many hosts tell all they have each frame.
TEST(Guest, WhatIsToldAgainChangesNothingAndCostsNoPass) {
    const HostRoom room;
    const HostCamera once(room.room(), {}), often(room.room(), {});
    Guest first(room), second(room);
    const AgiView view = first.addView(once), again = second.addView(often);
    const std::vector<AgiInstance> things = room.instances();
    const AgiLight light = spotAt({});
    for (int i = 0; i < kFrames; ++i) {
        first.drawFrame({{view, &once}});
        ASSERT_EQ(agiSetInstances(second.scene, 2, things.data()), AGI_OK);
        ASSERT_EQ(agiSetLights(second.scene, 1, &light), AGI_OK);
        second.drawFrame({{again, &often}});
    }
    EXPECT_TRUE(once.irradiance() == often.irradiance());
    EXPECT_FALSE(ran(again, "guest.rsms"));
    EXPECT_FALSE(ran(again, "surface_points.place"));
}

TEST(Guest, ThingsMoveComeAndGo) {
    const HostRoom room;
    const HostCamera camera(room.room(), {});
    Guest guest(room);
    const AgiView view = guest.addView(camera);
    guest.drawFrames(4, view, camera);
    std::vector<AgiInstance> things = room.instances();
    things[1].position[0] = 0.4;
    ASSERT_EQ(agiSetInstances(guest.scene, 1, &things[1]), AGI_OK);
    guest.drawFrames(2, view, camera);
    const uint64_t box = 11;
    ASSERT_EQ(agiRemoveInstances(guest.scene, 1, &box), AGI_OK);
    ASSERT_EQ(agiRemoveMeshes(guest.scene, 1, 1), AGI_OK);
    guest.drawFrames(2, view, camera);
    const uint64_t walls = 10;
    ASSERT_EQ(agiRemoveInstances(guest.scene, 1, &walls), AGI_OK);
    guest.drawFrames(2, view, camera);
    EXPECT_EQ(meanOf(camera.irradiance()), 0);
    ASSERT_EQ(agiSetInstances(guest.scene, 1, &things[0]), AGI_OK);
    guest.drawFrames(8, view, camera);
    EXPECT_GT(meanOf(camera.irradiance()), 0.01);
}

TEST(Guest, ReadingsPassesAndStatusArrive) {
    const HostRoom room;
    const HostCamera camera(room.room(), {});
    Guest guest(room);
    const AgiView view = guest.addView(camera);
    AgiProbe probe{7, {1.5, 0.5, 1}, {0, 1, 0}};
    ASSERT_EQ(agiSetProbes(guest.scene, 1, &probe), AGI_OK);
    const uint64_t ids[] = {7, 8};
    AgiReading readings[2];
    ASSERT_EQ(agiGetReadings(view, 2, ids, readings), AGI_OK);
    EXPECT_TRUE(std::isnan(readings[0].bounced[0]));
    guest.drawFrames(kFrames, view, camera);
    ASSERT_EQ(agiGetReadings(view, 2, ids, readings), AGI_OK);
    EXPECT_GT(readings[0].bounced[0], 0);
    EXPECT_TRUE(std::isnan(readings[1].bounced[0]));

    uint32_t count = 0;
    ASSERT_EQ(agiGetPasses(view, &count, nullptr), AGI_OK);
    ASSERT_GT(count, 5u);
    std::vector<AgiPass> passes(count);
    ASSERT_EQ(agiGetPasses(view, &count, passes.data()), AGI_OK);
    std::set<std::string> names;
    for (const AgiPass& pass : passes)
        names.insert(pass.name);
    EXPECT_TRUE(names.contains("guest.write_irradiance"));

    AgiStatus status{AGI_INIT(AgiStatus)};
    ASSERT_EQ(agiGetStatus(view, &status), AGI_OK);
    EXPECT_GT(status.virtualLights, 0u);
    EXPECT_GT(status.settled, 0);
}

TEST(Guest, OptionsHaveNamesAndAreSet) {
    const HostRoom room;
    const HostCamera camera(room.room(), {.size = {32, 18}});
    Guest guest(room);
    const AgiView view = guest.addView(camera);
    std::set<std::string> names;
    AgiOption option{AGI_INIT(AgiOption)};
    for (uint32_t i = 0; agiGetOption(view, i, &option) == AGI_OK; ++i) {
        EXPECT_TRUE(names.insert(option.name).second) << option.name;
        EXPECT_NE(std::string(option.help), "") << option.name;
        EXPECT_EQ(agiSetOption(view, option.name, std::string(option.value).c_str()), AGI_OK)
            << agiLastError();
    }
    EXPECT_GT(names.size(), 20u);
    EXPECT_EQ(agiSetOption(view, "val_clustering.count", "64"), AGI_OK) << agiLastError();
    guest.drawFrames(1, view, camera);
    AgiStatus status{AGI_INIT(AgiStatus)};
    ASSERT_EQ(agiGetStatus(view, &status), AGI_OK);
    EXPECT_EQ(status.virtualLights, 64u);
    EXPECT_EQ(agiSetOption(view, "val_clustering.count", "many"), AGI_ERROR_ARGUMENT);
    EXPECT_EQ(agiSetOption(view, "no.such", "1"), AGI_ERROR_ARGUMENT);
}

// The host's own memory, as a host would give it: a device allocation each, mapped where asked for.
struct HostMemory {
    int pieces = 0, made = 0;

    static VkResult allocate(void* user, VkDeviceSize bytes, uint32_t type, VkBool32 visible,
                             AgiMemoryPiece* piece) {
        auto& self = *static_cast<HostMemory*>(user);
        const VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, nullptr, bytes + 256, type};
        const gpu::Functions& vk = device().vk();
        if (const VkResult r = vk.AllocateMemory(device().handle(), &info, nullptr, &piece->memory)) return r;
        piece->offset = 256;  // not the beginning, as of a larger piece
        if (visible) {
            void* base = nullptr;
            vk.MapMemory(device().handle(), piece->memory, 0, VK_WHOLE_SIZE, 0, &base);
            piece->mapped = static_cast<std::byte*>(base) + 256;
        }
        piece->owner = new int(++self.made);
        ++self.pieces;
        return VK_SUCCESS;
    }
    static void release(void* user, const AgiMemoryPiece* piece) {
        delete static_cast<int*>(piece->owner);
        device().vk().FreeMemory(device().handle(), piece->memory, nullptr);
        --static_cast<HostMemory*>(user)->pieces;
    }
};

TEST(Guest, MemoryComesFromTheHostAndGoesBack) {
    const auto expected = lightOf({}, 4);
    HostMemory memory;
    {
        const HostRoom room;
        const HostCamera camera(room.room(), {});
        Guest guest(room,
                    {.allocate = HostMemory::allocate, .release = HostMemory::release, .user = &memory});
        guest.drawFrames(4, guest.addView(camera), camera);
        EXPECT_TRUE(camera.irradiance() == expected) << relativeError(camera.irradiance(), expected);
        EXPECT_GT(memory.pieces, 0);
        AgiMemory use{AGI_INIT(AgiMemory)};
        ASSERT_EQ(agiGetMemory(guest.context, &use), AGI_OK);
        EXPECT_GT(use.deviceBytes, 0u);
        EXPECT_GE(use.blockBytes, use.deviceBytes);
    }
    EXPECT_EQ(memory.pieces, 0);
}

}  // namespace
}  // namespace ag::test
