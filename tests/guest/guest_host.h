// A renderer that is not ours: its own device objects, its own G-buffer layout, and the library called as
// strangers call it.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "engine/core/image.h"
#include "engine/core/render_camera.h"
#include "engine/gpu/resources.h"
#include "gi/include/afterglow/afterglow_gi.h"
#include "tests/guest/room.h"
#include "tests/support/device_environment.h"

namespace ag::test {

// How a host keeps its G-buffer.
struct GbufferLayout {
    glm::uvec2 size{96, 54};
    bool reversedDepth = true, farPlane = false;
    AgiNormalEncoding normals = AGI_NORMAL_OCTAHEDRAL_SIGNED;
    bool gloss = false;
};

// The room's camera stands at `place` + (0.2, 1.4, 2.2) and looks into the room.
class HostCamera {
  public:
    HostCamera(const Room& room, const GbufferLayout& layout, glm::dvec3 place = glm::dvec3(0));
    // What a camera of ours saw, about an origin: m along its axis, 0 where nothing is; unit normals.
    HostCamera(const RenderCamera& camera, glm::dvec3 origin, const Image& depth, const Image& normal);
    // All but the frame's number and what is done.
    const AgiFrame& frame() const { return frame_; }
    std::vector<glm::vec3> irradiance() const { return download(*irradiance_); }
    std::vector<glm::vec3> gloss() const { return download(*gloss_); }

  private:
    struct Pixel {
        float distance = 0;  // m along the axis; 0: nothing is there
        glm::vec3 normal{0, 0, 1};
    };
    void setPerspective(const GbufferLayout& layout, float verticalFov);
    void fillGbuffer(const GbufferLayout& layout, const std::function<Pixel(uint32_t, uint32_t)>& at);
    void giveImages(const GbufferLayout& layout);
    std::vector<glm::vec3> download(const gpu::Image& image) const;

    AgiFrame frame_{};
    std::unique_ptr<gpu::Image> depth_, normal_, baseColor_, material_, irradiance_, gloss_;
};

struct HostHooks {  // what a host gives besides its device
    PFN_vkGetInstanceProcAddr getInstanceProcAddr = nullptr;
    VkResult (*allocate)(void* user, VkDeviceSize bytes, uint32_t type, VkBool32 visible,
                         AgiMemoryPiece* piece) = nullptr;
    void (*release)(void* user, const AgiMemoryPiece* piece) = nullptr;
    void* user = nullptr;
};

AgiContextInfo contextInfo(const HostHooks& hooks = {});

// The room's vertices and indices on the device, and what is said of them.
class HostRoom {
  public:
    HostRoom();
    const Room& room() const { return room_; }
    std::vector<AgiMesh> meshes() const;  // walls and box, of materials 0 and 1
    VkBuffer vertices() const { return vertices_->handle(); }
    VkBuffer indices() const { return indices_->handle(); }
    std::vector<AgiInstance> instances(glm::dvec3 place = glm::dvec3(0)) const;  // ids 10 and 11
    // All of it, and a spot under the ceiling; the first code that is not AGI_OK.
    AgiResult fill(AgiScene scene, glm::dvec3 place = glm::dvec3(0)) const;

  private:
    AgiMesh mesh(uint32_t firstIndex, uint32_t count, uint32_t material) const;
    Room room_ = makeRoom();
    std::unique_ptr<gpu::Buffer> vertices_, indices_;
};

AgiLight spotAt(glm::dvec3 place);

// A context, a scene with the room, and views by number; destroyed in the order the header asks for.
class Guest {
  public:
    explicit Guest(const HostHooks& hooks = {});  // its scene is empty
    explicit Guest(const HostRoom& room, const HostHooks& hooks = {}, glm::dvec3 place = glm::dvec3(0));
    ~Guest();
    Guest(const Guest&) = delete;
    Guest& operator=(const Guest&) = delete;

    AgiView addView(const HostCamera& camera, const char* preset = "low");
    // One command buffer with the frame of each camera in its view, executed before it returns.
    void drawFrame(std::initializer_list<std::pair<AgiView, const HostCamera*>> views);
    void drawFrames(int count, AgiView view, const HostCamera& camera);

    AgiContext context = nullptr;
    AgiScene scene = nullptr;
    uint64_t frame = 0;
    std::function<void(AgiFrame&)> change;  // of each frame before it is recorded; or none

  private:
    std::vector<AgiView> views_;
};

double meanOf(const std::vector<glm::vec3>& picture);
// Root mean square of the difference over the mean of `expected`.
double relativeError(const std::vector<glm::vec3>& picture, const std::vector<glm::vec3>& expected);

}  // namespace ag::test
