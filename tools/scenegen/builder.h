// Building scenes from boxes and quads in a readable way.
#pragma once

#include <array>
#include <string>

#include "engine/scene/scene_asset.h"
#include "tools/scenegen/shapes.h"

namespace ag::scenegen {

// A spot has its whole intensity within the inner angle off its axis, none past the outer, degrees.
struct SpotCone {
    float inner = 0, outer = 45;
};

class SceneBuilder {
  public:
    explicit SceneBuilder(std::string name) { asset_.name = std::move(name); }
    explicit SceneBuilder(SceneAsset start) : asset_(std::move(start)) {}  // goes on with it

    // Lambert: metallic 0, roughness 1, no specular. Returns the material's index.
    uint32_t material(const std::string& name, glm::vec3 albedo);
    uint32_t emissive(const std::string& name, glm::vec3 albedo, glm::vec3 radiance);

    // A parallelogram corner + [0,1] u + [0,1] v; its front looks along cross(u, v).
    uint32_t quad(const std::string& name, glm::vec3 corner, glm::vec3 u, glm::vec3 v, uint32_t material);
    // A box about the node's origin, outward faces. Returns the node.
    uint32_t box(const std::string& name, glm::vec3 center, glm::vec3 size, uint32_t material, float yaw = 0);
    // A mesh of any shape, in its own frame.
    uint32_t model(const std::string& name, const MeshParts& parts, glm::vec3 center, float yaw = 0);
    // A node without a mesh: a place, or the parent of others.
    uint32_t place(const std::string& name, glm::vec3 center, float yaw = 0);
    // `child` from now on stands in the frame of `parent`, which was added before it.
    void attach(uint32_t child, uint32_t parent);
    Material& materialAt(uint32_t index) { return asset_.geometry.materials[index]; }
    // Another node with the mesh of `node`.
    uint32_t copy(uint32_t node, const std::string& name, glm::vec3 center, float yaw = 0);
    // The inside of a room, each face with its own material: -x +x -y +y -z +z; ~0u leaves the face out.
    void room(const std::string& name, glm::vec3 min, glm::vec3 max,
              const std::array<uint32_t, 6>& materials);

    uint32_t spot(const std::string& name, glm::vec3 position, glm::vec3 direction, glm::vec3 intensity,
                  SpotCone cone, float range = 0);
    uint32_t point(const std::string& name, glm::vec3 position, glm::vec3 intensity, float range = 0);
    uint32_t sun(const std::string& name, glm::vec3 direction, glm::vec3 irradiance);
    void sky(Sky sky) { asset_.sky = std::make_shared<const Sky>(std::move(sky)); }
    uint32_t camera(const std::string& name, glm::vec3 position, glm::vec3 target, float verticalFovDegrees);

    SceneNode& node(uint32_t index) { return asset_.nodes[index]; }
    SceneAsset finish() { return std::move(asset_); }

  private:
    uint32_t addNode(SceneNode node);
    uint32_t beginMesh(const std::string& name);
    void addQuad(glm::vec3 corner, glm::vec3 u, glm::vec3 v, uint32_t material);
    uint32_t addLight(SceneLight light, glm::vec3 position, glm::vec3 direction);

    SceneAsset asset_;
};

// Rotation that turns -Z to `direction`.
glm::quat lookRotation(glm::vec3 direction);

}  // namespace ag::scenegen
