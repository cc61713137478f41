// A host's world in device memory, in the units and about the origin that one view renders it in.
#pragma once

#include "engine/frame/frame_graph.h"
#include "engine/gpu/resources.h"
#include "gi/library/guest_scene.h"
#include "gi/units.h"

namespace ag::guest {

class SceneOnDevice {
  public:
    explicit SceneOnDevice(gpu::Context& context) : context_(context) {}
    ~SceneOnDevice();
    SceneOnDevice(const SceneOnDevice&) = delete;
    SceneOnDevice& operator=(const SceneOnDevice&) = delete;

    // Takes what changed since last time; nothing is recorded yet. True if all that was known of the light is
    // lost: another scene, other units.
    bool update(GuestScene& scene, glm::dvec3 camera);
    // Records the copies of what was taken.
    void upload(VkCommandBuffer commands);

    gi::RenderUnits units() const { return units_; }
    glm::dvec3 origin() const { return origin_; }  // in the world, m
    glm::vec3 toOurs(glm::dvec3 world) const { return glm::vec3((world - origin_) / double(units_.length)); }
    // Of the frame: valid until the next update().
    gi::World world() const;
    gi::Occluders occluders(GraphScope scope) const;
    gi::SkyOnDevice sky(GraphScope scope) const;
    bool hasSky() const { return skyVersion_ != 0; }
    std::span<const RenderProbe> probes() const { return probes_; }
    // Of an instance, in our units.
    const Bounds& boundsOf(size_t row) const { return rowBounds_[row]; }
    const std::vector<uint64_t>& rowVersions() const { return rowVersions_; }
    // Where all rows stand, in our units.
    uint64_t placesVersion() const;

  private:
    struct Copy {
        const gpu::Buffer* to;
        uint64_t offset = 0, from = 0, sizeBytes = 0;  // `from`: in bytes_
    };
    void follow(glm::dvec3 camera);
    void chooseUnits(GuestScene& scene);
    void takeInstances(GuestScene& scene);
    void takePoints(GuestScene& scene);
    void takeTrees(GuestScene& scene);
    void uploadTrees(GuestScene& scene);
    void placeTrees(const GuestScene& scene);
    void takeSky(const GuestScene& scene);
    void takeLights(const GuestScene& scene);
    void stage(std::span<const std::byte> bytes, const gpu::Buffer& to, uint64_t offset);
    template <class T>
    std::unique_ptr<gpu::Buffer> make(const char* name, std::span<const T> items, VkFormat texelFormat);
    template <class T>
    void fill(std::unique_ptr<gpu::Buffer>& buffer, const char* name, const std::vector<T>& items,
              VkFormat texelFormat);

    gpu::Context& context_;
    uint64_t scene_ = 0;  // GuestScene::id
    uint64_t setVersion_ = 0, movedVersion_ = 0, lightsVersion_ = 0, staticVersion_ = 0;
    glm::dvec3 origin_{0};
    bool originIsChosen_ = false;
    gi::RenderUnits units_;
    uint64_t origins_ = 1, cameras_ = 0;
    glm::dvec3 camera_{0};
    Bounds bounds_;
    float extent_ = 0;
    bool allAnew_ = true;  // every row: origin, units or set are others

    std::unique_ptr<gpu::Buffer> instances_, samples_, pointAreas_, bouncePoints_;
    uint32_t sampleCount_ = 0, staticCount_ = 0, bounceCount_ = 0, emissiveCount_ = 0;
    float emissiveFlux_ = 0, bounceArea_ = 0, emissiveArea_ = 0;  // in our units
    uint64_t pointsSet_ = 0;
    gi::TreeUpkeep upkeep_;
    std::unique_ptr<gpu::Buffer> treeNodes_, treeTriangles_, treePlaces_, moverNodes_;
    gi::OccluderTrees ranges_;  // of what is in them: neither nodes nor triangles
    glm::dvec3 treesMiddle_{0};
    gi::MoverTree movers_;
    uint64_t treesBuilt_ = 0;     // a hash of what is in them; 0: there are none
    uint64_t treesStand_ = 0;     // of that and of where what is static in them stands,
    uint64_t treesPlaced_ = 0;    // and of where all of it does
    bool treesAreStale_ = false;  // they are of what was static some frames ago
    std::unique_ptr<gpu::Buffer> skyTexels_, skyCells_, skyUpTo_;
    uint64_t skyVersion_ = 0;  // a hash of the sky and its unit; 0: there is none
    std::vector<Bounds> rowBounds_;
    std::vector<uint64_t> rowVersions_;
    std::vector<gi::RsmLight> lights_;
    std::vector<RenderProbe> probes_;
    std::vector<gi::MovedThing> moved_;
    std::vector<Copy> copies_;
    std::vector<std::byte> bytes_;
};

}  // namespace ag::guest
