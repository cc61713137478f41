// A host's world: what is behind an AgiScene. Nothing here is on the device but the sets that draws bind.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "engine/core/hash.h"
#include "engine/core/render_probe.h"
#include "gi/bounce_points.h"
#include "gi/inputs.h"
#include "gi/library/guest_context.h"
#include "gi/occluder_trees.h"
#include "gi/sky.h"

namespace ag::guest {

struct GuestMaterial {
    glm::vec3 albedo{1}, mean{1};
    VkImageView map = VK_NULL_HANDLE;
    float alphaCutoff = 0, coverage = 1;
    bool doubleSided = false;
    glm::vec3 emissive{0};  // W/(m² sr)

    bool operator==(const GuestMaterial&) const = default;
};

struct GuestMesh {
    AgiMesh given;  // its buffers; host pointers are not kept
    std::vector<glm::vec3> positions, normals;
    std::vector<glm::vec2> uvs;
    std::vector<uint32_t> indices;  // fronts are counter-clockwise
    Bounds bounds;                  // m, of the mesh itself
    bool there = true;
    uint32_t instances = 0;
    bool hasTree = false;  // of its own: it moves, or did
};

struct GuestInstance {
    uint64_t id = 0;
    uint32_t mesh = 0;
    bool movable = false;
    glm::dvec3 position{0};
    glm::mat3 linear{1};
    uint64_t moved = 0;  // version of the scene when it was changed last

    bool standsAs(const GuestInstance& o) const {
        return mesh == o.mesh && movable == o.movable && position == o.position && linear == o.linear;
    }
};

struct GuestLight {
    gi::RsmLight light;  // but for its position
    glm::dvec3 position{0};

    bool operator==(const GuestLight&) const = default;
};

struct GuestProbe {
    uint64_t id = 0;
    glm::dvec3 position{0};
    glm::vec3 normal{0};
};

// Points on all surfaces, in the meshes' own coordinates; areas in m², what they shine in W/(m² sr).
struct GuestPoints {
    uint64_t set = 0;  // which instances and meshes they are on
    gi::SurfaceSamples samples;
    std::vector<io::BouncePoint> reflecting, emissive;
};

// Trees for rays: of what is static about a place in the world, in m; of meshes that move in their own
// coordinates. Radiance in W/(m² sr).
struct GuestTrees {
    uint64_t version = 0;  // GuestScene::treesVersion
    glm::dvec3 middle{0};
    gi::OccluderTrees trees;
};

struct GuestSky {
    gi::SkyTable table;    // W/(m² sr); empty: there is none
    float mean = 0;        // of all directions, the strongest channel
    uint64_t version = 0;  // 0: there is none
};

class GuestScene {
  public:
    explicit GuestScene(GuestContext& context) : context_(context), id_(context.nameScene()) {}

    // What was asked for, already found to be possible. What is as it was changes nothing.
    uint32_t addMaterials(std::vector<GuestMaterial> materials);
    void updateMaterials(uint32_t first, std::vector<GuestMaterial> materials);
    uint32_t addMeshes(std::vector<GuestMesh> meshes);
    void removeMeshes(uint32_t first, uint32_t count);
    void setInstance(const GuestInstance& instance);
    void removeInstance(uint64_t id);
    void setLights(std::vector<GuestLight> lights);
    void setProbes(std::vector<GuestProbe> probes) { probes_ = std::move(probes); }
    void setSky(GuestSky sky) { sky_ = std::move(sky); }

    const std::vector<GuestMaterial>& materials() const { return materials_; }
    const std::vector<GuestMesh>& meshes() const { return meshes_; }
    const std::vector<GuestInstance>& instances() const { return instances_; }
    const std::vector<GuestLight>& lights() const { return lights_; }
    const std::vector<GuestProbe>& probes() const { return probes_; }
    const GuestSky& sky() const { return sky_; }
    float mostEmissive() const;  // W/(m² sr), of the materials that instances have; 0: nothing shines
    bool allHaveBuffers() const { return withoutBuffers_ == 0; }  // meshes, so that the library can draw them
    bool has(uint64_t instance) const { return rowOf_.contains(instance); }

    GuestContext& context() const { return context_; }
    uint64_t id() const { return id_; }  // of no other scene of the context, then or later; never 0
    // Numbers that change with what they are about; never 0.
    uint64_t setVersion() const { return setVersion_; }      // which instances and meshes there are
    uint64_t movedVersion() const { return movedVersion_; }  // where anything stands
    uint64_t lightsVersion() const { return lightsVersion_; }
    uint64_t drawnVersion() const { return drawnVersion_; }  // materials and meshes, as RSMs show them

    // Chosen anew if the set changed: some 100 ms for a large scene.
    const GuestPoints& points();
    // Built anew if what they are of changed: half a second for 250,000 triangles.
    const GuestTrees& trees();
    uint64_t staticVersion() const { return staticVersion_; }  // what is static and where; never 0
    // Also which meshes move; never 0.
    uint64_t treesVersion() const { return combineHash(staticVersion_, movingVersion_); }
    // In the world; m.
    struct DoubleBounds {
        glm::dvec3 min{1e300}, max{-1e300};
    };
    const DoubleBounds& bounds();
    static Bounds boundsOf(const GuestInstance& instance, const Bounds& local, glm::dvec3 origin);

  private:
    void addInstance(const GuestInstance& instance);
    void count(const GuestInstance& instance, int by);
    glm::dvec3 middle();
    const GuestMaterial& materialOf(uint32_t mesh) const;
    std::vector<io::BouncePoint> chooseEmissivePoints(std::span<gi::SampledMesh> meshes,
                                                      const gi::SampledScene& scene) const;
    template <class Use>
    void withSurfaces(glm::dvec3 middle, Use&& use);

    GuestContext& context_;
    uint64_t id_;
    std::vector<GuestMaterial> materials_;
    std::vector<GuestMesh> meshes_;
    size_t withoutBuffers_ = 0;  // of the meshes
    std::vector<GuestInstance> instances_;
    std::unordered_map<uint64_t, size_t> rowOf_;
    std::vector<GuestLight> lights_;
    std::vector<GuestProbe> probes_;
    uint64_t setVersion_ = 1, movedVersion_ = 1, lightsVersion_ = 1, drawnVersion_ = 1;
    uint64_t staticVersion_ = 1, movingVersion_ = 1;
    GuestSky sky_;
    GuestPoints points_;
    GuestTrees trees_;
    DoubleBounds bounds_;
    uint64_t boundsOf_ = 0;  // movedVersion_ they are of
};

}  // namespace ag::guest
