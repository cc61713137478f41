// What cannot be is refused with a sentence, and nothing is changed by asking.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "tests/guest/guest_host.h"

namespace ag::test {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

class GuestArguments : public testing::Test {
  protected:
    template <class T>
    using Change = std::function<void(T&)>;

    void refused(AgiResult result, int line) {
        EXPECT_EQ(result, AGI_ERROR_ARGUMENT) << "line " << line;
        EXPECT_GT(std::string(agiLastError()).size(), 8u) << "line " << line;
    }
    void refusedFrame(int line, const Change<AgiFrame>& change) {
        AgiFrame f = camera_.frame();
        f.frame = guest_.frame + 1;
        f.framesDone = guest_.frame;
        change(f);
        device().runOnce(
            [&](VkCommandBuffer commands) { refused(agiRecord(view_, guest_.scene, commands, &f), line); });
    }
    void refusedMesh(int line, const Change<AgiMesh>& change) {
        AgiMesh mesh = room_.meshes()[0];
        change(mesh);
        uint32_t first = 0;
        refused(agiAddMeshes(guest_.scene, 1, &mesh, &first), line);
    }
    void refusedLight(int line, const Change<AgiLight>& change) {
        AgiLight light = spotAt({});
        change(light);
        refused(agiSetLights(guest_.scene, 1, &light), line);
    }
    void refusedInstance(int line, const Change<AgiInstance>& change) {
        std::vector<AgiInstance> two = room_.instances();  // of which the first is fine
        two[0].position[0] = 100;
        change(two[1]);
        refused(agiSetInstances(guest_.scene, 2, two.data()), line);
    }
    void refusedMaterial(int line, const Change<AgiMaterial>& change) {
        AgiMaterial material{AGI_INIT(AgiMaterial)};
        change(material);
        uint32_t first = 0;
        refused(agiAddMaterials(guest_.scene, 1, &material, &first), line);
        refused(agiUpdateMaterials(guest_.scene, 0, 1, &material), line);
    }

    HostRoom room_;
    HostCamera camera_{room_.room(), {.size = {32, 18}}};
    Guest guest_{room_};
    AgiView view_ = guest_.addView(camera_);
};

#define REFUSED(call) refused((call), __LINE__)

TEST_F(GuestArguments, AreLookedAtAndNothingIsChanged) {
    guest_.drawFrames(2, view_, camera_);

    refusedFrame(__LINE__, [](AgiFrame& f) { f.structSize = 0; });
    refusedFrame(__LINE__, [](AgiFrame& f) { f.frame = 0; });
    refusedFrame(__LINE__, [](AgiFrame& f) { f.frame = 1; });
    refusedFrame(__LINE__, [](AgiFrame& f) { f.framesDone = f.frame; });
    refusedFrame(__LINE__, [](AgiFrame& f) { f.width = 0; });
    refusedFrame(__LINE__, [](AgiFrame& f) { f.height = 1u << 20; });
    refusedFrame(__LINE__, [](AgiFrame& f) { f.cameraPosition[1] = kNan; });
    refusedFrame(__LINE__, [](AgiFrame& f) { f.viewFromWorld[0] = 2; });
    refusedFrame(__LINE__, [](AgiFrame& f) { f.viewFromWorld[3] = 1; });
    refusedFrame(__LINE__, [](AgiFrame& f) { f.clipFromView[11] = 0; });
    refusedFrame(__LINE__, [](AgiFrame& f) { f.clipFromView[14] = kNan; });
    refusedFrame(__LINE__, [](AgiFrame& f) { f.depth.view = VK_NULL_HANDLE; });
    refusedFrame(__LINE__, [](AgiFrame& f) { f.irradiance.image = VK_NULL_HANDLE; });
    refusedFrame(__LINE__, [](AgiFrame& f) { f.irradiance.format = VK_FORMAT_R8G8B8A8_UNORM; });
    refusedFrame(__LINE__, [](AgiFrame& f) { f.gloss = f.irradiance; });
    refusedFrame(__LINE__, [](AgiFrame& f) { f.normalEncoding = AgiNormalEncoding(4); });
    refusedFrame(__LINE__, [](AgiFrame& f) { f.metallicChannel = 4; });

    refusedMesh(__LINE__, [](AgiMesh& m) { m.vertexBuffer = VK_NULL_HANDLE; });
    refusedMesh(__LINE__, [](AgiMesh& m) { m.indices = nullptr; });
    refusedMesh(__LINE__, [](AgiMesh& m) { m.indexCount = 4; });
    refusedMesh(__LINE__, [](AgiMesh& m) { m.positionStride = 8; });
    refusedMesh(__LINE__, [](AgiMesh& m) { m.indexType = VK_INDEX_TYPE_NONE_KHR; });
    refusedMesh(__LINE__, [](AgiMesh& m) { m.material = 2; });
    refusedMesh(__LINE__, [](AgiMesh& m) { m.vertexCount = 3; });

    refusedLight(__LINE__, [](AgiLight& l) { l.kind = AgiLightKind(7); });
    refusedLight(__LINE__, [](AgiLight& l) { l.intensity[1] = -1; });
    refusedLight(__LINE__, [](AgiLight& l) { l.position[0] = kNan; });
    refusedLight(__LINE__, [](AgiLight& l) { l.direction[0] = 4; });
    refusedLight(__LINE__, [](AgiLight& l) { l.outerAngle = 2; });
    refusedLight(__LINE__, [](AgiLight& l) { l.innerAngle = 1; });
    refusedLight(__LINE__, [](AgiLight& l) { l.mapSize = 4096; });

    refusedInstance(__LINE__, [](AgiInstance& i) { i.mesh = 2; });
    refusedInstance(__LINE__, [](AgiInstance& i) { i.linear[4] = INFINITY; });
    refusedInstance(__LINE__, [](AgiInstance& i) { i.structSize = 0; });

    refusedMaterial(__LINE__, [](AgiMaterial& m) { m.albedo[0] = -0.1f; });
    refusedMaterial(__LINE__, [](AgiMaterial& m) { m.coverage = 2; });
    refusedMaterial(__LINE__, [](AgiMaterial& m) { m.alphaCutoff = kNan; });

    const uint64_t none = 99, twice[] = {10, 10};
    REFUSED(agiRemoveInstances(guest_.scene, 1, &none));
    REFUSED(agiRemoveInstances(guest_.scene, 2, twice));
    REFUSED(agiRemoveMeshes(guest_.scene, 0, 1));  // it has an instance
    REFUSED(agiRemoveMeshes(guest_.scene, 1, 2));
    REFUSED(agiUpdateMaterials(guest_.scene, 2, 1, nullptr));
    const AgiProbe probe{1, {0, 0, 0}, {0, 2, 0}};
    REFUSED(agiSetProbes(guest_.scene, 1, &probe));
    REFUSED(agiSetProbes(guest_.scene, 5000, &probe));

    // All is as it was: the same pictures as of a host that never asked for any of this.
    guest_.drawFrames(2, view_, camera_);
    const HostCamera other(room_.room(), {.size = {32, 18}});
    Guest well(room_);
    well.drawFrames(4, well.addView(other), other);
    EXPECT_TRUE(camera_.irradiance() == other.irradiance());
}

TEST_F(GuestArguments, NullsAreRefused) {
    uint32_t count = 0;
    AgiView view = nullptr;
    REFUSED(agiCreateContext(nullptr, nullptr));
    REFUSED(agiCreateScene(nullptr, nullptr));
    REFUSED(agiCreateView(guest_.context, nullptr, &view));
    REFUSED(agiAddMaterials(guest_.scene, 1, nullptr, &count));
    REFUSED(agiAddMaterials(guest_.scene, 0, nullptr, nullptr));
    REFUSED(agiAddMeshes(guest_.scene, 1, nullptr, &count));
    REFUSED(agiSetInstances(guest_.scene, 1, nullptr));
    REFUSED(agiRemoveInstances(guest_.scene, 1, nullptr));
    REFUSED(agiSetLights(guest_.scene, 1, nullptr));
    REFUSED(agiSetProbes(guest_.scene, 1, nullptr));
    REFUSED(agiGetOption(view_, 0, nullptr));
    REFUSED(agiSetOption(view_, nullptr, "1"));
    REFUSED(agiPrepare(nullptr, guest_.scene));
    REFUSED(agiPrepare(view_, nullptr));
    REFUSED(agiRecord(view_, guest_.scene, VK_NULL_HANDLE, nullptr));
    REFUSED(agiGetPasses(view_, nullptr, nullptr));
    REFUSED(agiGetReadings(view_, 1, nullptr, nullptr));
    REFUSED(agiGetStatus(view_, nullptr));
    REFUSED(agiGetMemory(guest_.context, nullptr));
    agiDestroyView(nullptr);
    agiDestroyScene(nullptr);
    agiDestroyContext(nullptr);
}

TEST_F(GuestArguments, PresetsAndContextsAreTheirOwn) {
    AgiViewInfo info{AGI_INIT(AgiViewInfo)};
    info.preset = "best";
    AgiView view = nullptr;
    REFUSED(agiCreateView(guest_.context, &info, &view));
    const Guest other(room_);
    REFUSED(agiPrepare(view_, other.scene));
    AgiContextInfo half = contextInfo();
    half.allocate = [](void*, VkDeviceSize, uint32_t, VkBool32, AgiMemoryPiece*) { return VK_SUCCESS; };
    AgiContext context = nullptr;
    REFUSED(agiCreateContext(&half, &context));
}

// A host that was compiled with fewer fields, and one with more.
TEST_F(GuestArguments, OlderAndNewerHostsAreUnderstood) {
    AgiFrame f = camera_.frame();
    f.frame = guest_.frame = 1;
    f.structSize = offsetof(AgiFrame, gloss);
    f.gloss.view = VkImageView(uintptr_t(8));  // behind what this host knows of
    device().runOnce([&](VkCommandBuffer commands) {
        EXPECT_EQ(agiRecord(view_, guest_.scene, commands, &f), AGI_OK) << agiLastError();
    });

    struct NewerLight {
        AgiLight light;
        double more[3];
    } lights[2] = {{spotAt({}), {}}, {spotAt({1, 0, 0}), {}}};
    for (NewerLight& l : lights)
        l.light.structSize = sizeof l;
    lights[1].light.id = 4;
    EXPECT_EQ(agiSetLights(guest_.scene, 2, &lights[0].light), AGI_OK) << agiLastError();

    // One of version 1.1 knows of no emission: what stood in its padding is none.
    AgiMaterial old{AGI_INIT(AgiMaterial)};
    old.structSize = 64;
    old.reserved = ~0u;
    old.emissive[0] = kNan;
    EXPECT_EQ(agiUpdateMaterials(guest_.scene, 0, 1, &old), AGI_OK) << agiLastError();

    AgiStatus status{AGI_INIT(AgiStatus)};
    status.structSize = offsetof(AgiStatus, settled);
    status.settled = -1;
    EXPECT_EQ(agiGetStatus(view_, &status), AGI_OK);
    EXPECT_EQ(status.settled, -1);
}

TEST_F(GuestArguments, VersionAndRequirementsAreTold) {
    EXPECT_EQ(agiVersion(), uint32_t(AGI_VERSION));
    AgiRequirements needed{AGI_INIT(AgiRequirements)};
    ASSERT_EQ(agiGetRequirements(device().context().instance(), device().context().physical(),
                                 device().vk().GetInstanceProcAddr, &needed),
              AGI_OK)
        << agiLastError();
    ASSERT_NE(needed.features, nullptr);
    EXPECT_EQ(needed.features->sType, VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2);
    REFUSED(agiGetRequirements(device().context().instance(), nullptr, nullptr, &needed));
}

}  // namespace
}  // namespace ag::test
