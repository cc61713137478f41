// A host's triangles drawn into reflective shadow maps, by a pass that records by itself.
#pragma once

#include "gi/library/scene_on_device.h"
#include "gi/rsm.h"

namespace ag::guest {

class RsmDraws {
  public:
    explicit RsmDraws(GuestContext& context) : context_(context) {}
    ~RsmDraws();
    RsmDraws(const RsmDraws&) = delete;
    RsmDraws& operator=(const RsmDraws&) = delete;

    // Declares the pass; `scene` and `device` live until the graph is executed.
    void add(GraphScope scope, const GuestScene& scene, const SceneOnDevice& device, BufferHandle instances,
             gi::RsmSet& rsm);

  private:
    struct Draw {
        uint32_t row, mesh;
    };
    void listFaces(const GuestScene& scene, const SceneOnDevice& device, const gi::RsmSet& rsm);
    void listDraws(const GuestScene& scene, const SceneOnDevice& device, const glm::mat4& clipFromWorld);
    void record(const PassRecording& to, const GuestScene& scene, const gi::RsmSet& rsm);
    void drawFace(const PassRecording& to, const GuestScene& scene, const io::RsmFace& face,
                  std::span<const Draw> draws);
    void makeSets(const GuestScene& scene, const gpu::Pipeline& pipeline);
    struct Pool {
        explicit Pool(gpu::Context& of) : context(of) {}
        ~Pool();
        Pool(const Pool&) = delete;
        Pool& operator=(const Pool&) = delete;
        gpu::Context& context;
        VkDescriptorPool handle = VK_NULL_HANDLE;
    };

    GuestContext& context_;
    std::vector<Draw> draws_;
    std::vector<size_t> firstOfFace_;
    uint64_t listedOf_ = 0, key_ = 0;  // what the list is of; what it draws
    std::unique_ptr<Pool> pool_;
    std::vector<VkDescriptorSet> sets_;  // by material
    uint64_t setsOf_ = 0;
};

}  // namespace ag::guest
