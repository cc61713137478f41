// A host that draws the reflective shadow maps itself, with its own pipeline.
#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "engine/gpu/pipeline.h"
#include "tests/guest/guest_host.h"

namespace ag::test {
namespace {

gpu::PipelineRequest requestOf() {
    gpu::PipelineRequest r{.vertexShader = "test/host_rsm.vert", .fragmentShader = "test/host_rsm.frag"};
    r.raster.vertexLayout = gpu::VertexLayout::kStrided;
    r.raster.depthTest = r.raster.depthWrite = true;
    r.raster.colorFormats = {VK_FORMAT_R16G16B16A16_SFLOAT, VK_FORMAT_R16G16B16A16_SFLOAT};
    r.raster.colorCount = 2;
    r.raster.depthFormat = VK_FORMAT_D32_SFLOAT;
    return r;
}

// Draws the room, without the library's knowledge of its buffers.
class RsmPainter {
  public:
    RsmPainter(const HostRoom& room, glm::dvec3 place)
        : room_(room), place_(place), pipeline_(device().pipelines().get(requestOf())) {}

    // From now on it draws in the library's place.
    void join(Guest& guest) {
        guest.change = [this](AgiFrame& f) {
            f.drawRsmFace = [](void* self, VkCommandBuffer commands, const AgiRsmFace* face) {
                static_cast<RsmPainter*>(self)->draw(commands, *face);
            };
            f.drawRsmUser = this;
            f.drawRsmVersion = version;
        };
    }

    uint64_t version = 1;
    bool withBox = true;
    int faces = 0;  // drawn so far
    AgiRsmFace last{};

  private:
    void draw(VkCommandBuffer commands, const AgiRsmFace& face) {
        ++faces;
        last = face;
        const gpu::Functions& vk = device().vk();
        const auto& [offset, extent] = face.area;
        const VkViewport viewport{
            float(offset.x), float(offset.y), float(extent.width), float(extent.height), 0, 1};
        vk.CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline_.handle);
        vk.CmdSetViewport(commands, 0, 1, &viewport);
        vk.CmdSetScissor(commands, 0, 1, &face.area);
        vk.CmdSetFrontFace(commands, VK_FRONT_FACE_COUNTER_CLOCKWISE);
        const VkBuffer buffer = room_.vertices();
        const VkBuffer buffers[3] = {buffer, buffer, buffer};
        const VkDeviceSize offsets[3] = {offsetof(RoomVertex, position), offsetof(RoomVertex, normal),
                                         offsetof(RoomVertex, color)};
        const VkDeviceSize strides[3] = {sizeof(RoomVertex), sizeof(RoomVertex), sizeof(RoomVertex)};
        vk.CmdBindVertexBuffers2(commands, 0, 3, buffers, offsets, nullptr, strides);
        vk.CmdBindIndexBuffer(commands, room_.indices(), 0, VK_INDEX_TYPE_UINT16);
        const uint32_t walls = room_.room().wallIndices, all = uint32_t(room_.room().indices.size());
        drawPart(commands, face, 0, walls, glm::vec3(0.7f));
        if (withBox) drawPart(commands, face, walls, all - walls, {0.8f, 0.2f, 0.2f});
    }

    void drawPart(VkCommandBuffer commands, const AgiRsmFace& face, uint32_t first, uint32_t count,
                  glm::vec3 albedo) {
        struct {
            glm::mat4 clipFromMesh;
            glm::vec3 albedo;
        } push{glm::mat4(1), albedo};
        std::copy_n(face.clipFromLocal, 16, &push.clipFromMesh[0].x);
        const glm::dvec3 origin(face.origin[0], face.origin[1], face.origin[2]);
        push.clipFromMesh = glm::translate(push.clipFromMesh, glm::vec3(place_ - origin));
        device().vk().CmdPushConstants(commands, pipeline_.layout, pipeline_.pushStages, 0,
                                       pipeline_.pushSizeBytes, &push);
        device().vk().CmdDrawIndexed(commands, count, 1, first, 0, 0);
    }

    const HostRoom& room_;
    glm::dvec3 place_;
    const gpu::Pipeline& pipeline_;
};

TEST(HostRsm, IsLitAsByTheLibrarysOwn) {
    const glm::dvec3 place(1e5, 0, -2e5);
    const HostRoom room;
    const HostCamera own(room.room(), {}, place), other(room.room(), {}, place);
    Guest expected(room, {}, place), guest(room, {}, place);
    RsmPainter painter(room, place);
    painter.join(guest);
    expected.drawFrames(12, expected.addView(own), own);
    guest.drawFrames(12, guest.addView(other), other);
    EXPECT_GT(meanOf(own.irradiance()), 0.01);
    EXPECT_LT(relativeError(other.irradiance(), own.irradiance()), 0.01);  // rounded otherwise
    EXPECT_EQ(painter.last.light, 3u);
}

TEST(HostRsm, IsAskedForOnlyWhatChanged) {
    const HostRoom room;
    const HostCamera camera(room.room(), {});
    Guest guest(room);
    RsmPainter painter(room, {});
    painter.join(guest);
    const AgiView view = guest.addView(camera);
    guest.drawFrames(3, view, camera);
    EXPECT_EQ(painter.faces, 1) << "nothing changed after the first frame";
    const double before = meanOf(camera.irradiance());
    painter.withBox = false;
    guest.drawFrames(1, view, camera);
    EXPECT_EQ(painter.faces, 1) << "the version is the same";
    ++painter.version;
    guest.drawFrames(8, view, camera);
    EXPECT_EQ(painter.faces, 2);
    EXPECT_NE(meanOf(camera.irradiance()), before) << "the red box is gone from the maps";
}

TEST(HostRsm, MeshesWithoutBuffersNeedIt) {
    const HostRoom room;
    const HostCamera camera(room.room(), {});
    Guest guest(room);
    AgiMesh bare = room.meshes()[1];
    bare.vertexBuffer = bare.indexBuffer = VK_NULL_HANDLE;
    uint32_t id = 0;
    ASSERT_EQ(agiAddMeshes(guest.scene, 1, &bare, &id), AGI_OK) << agiLastError();
    AgiInstance instance = room.instances()[1];
    instance.mesh = id;
    ASSERT_EQ(agiSetInstances(guest.scene, 1, &instance), AGI_OK) << agiLastError();
    const AgiView view = guest.addView(camera);
    AgiFrame f = camera.frame();
    f.frame = 1;
    device().runOnce([&](VkCommandBuffer commands) {
        EXPECT_EQ(agiRecord(view, guest.scene, commands, &f), AGI_ERROR_ARGUMENT);
        EXPECT_STREQ(agiLastError(), "a mesh has no vertex and index buffer, and the frame no drawRsmFace");
    });
    RsmPainter painter(room, {});
    painter.join(guest);
    guest.drawFrames(4, view, camera);
    EXPECT_GT(meanOf(camera.irradiance()), 0.01);
    bare.indexBuffer = room.indices();
    EXPECT_EQ(agiAddMeshes(guest.scene, 1, &bare, &id), AGI_ERROR_ARGUMENT);
}

}  // namespace
}  // namespace ag::test
