// What the renderer sees: flat arrays, no ECS types. Written by extract_system, read by gi/.
//
// Positions are relative to `originWorld`, a double-precision point near the camera that moves rarely (in
// large steps); when it does, everything is stamped anew. Each array carries a version that changes with its
// contents.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <glm/glm.hpp>
#include <glm/gtc/type_precision.hpp>

#include "engine/core/bounds.h"
#include "engine/core/light_kind.h"
#include "engine/core/render_camera.h"
#include "engine/core/render_probe.h"
#include "engine/scene/sky.h"

namespace ag {

struct VertexAttributes {  // 40 bytes: gpu::VertexLayout::kPositionsAndAttributes, binding 1
    glm::vec3 normal{0, 1, 0};
    glm::vec4 tangent{1, 0, 0, 1};  // w: handedness; all zero: derive it in the shader
    glm::vec2 uv{0};
    uint32_t color = ~0u;  // linear, factor of the base colour: A2B10G10R10, white; the alpha is not used
};

// By how much which joints of a skinned mesh move a vertex.
struct SkinVertex {
    glm::u16vec4 joints{0};
    glm::vec4 weights{0};  // none negative, 1 together
};

// A range of the index buffer drawn with one material.
struct Primitive {
    uint32_t firstIndex = 0;
    uint32_t indexCount = 0;
    int32_t vertexOffset = 0;
    uint32_t material = 0;
    Bounds boundsLocal;
};

// Square texture size classes: each is one array image, a material's textures all lie in one class.
enum class TextureClass : uint32_t { kNone, k256, k512, k1024, k2048 };
constexpr uint32_t kTextureClassCount = 5;
constexpr uint32_t textureClassSize(TextureClass c) {
    return c == TextureClass::kNone ? 0 : 128u << uint32_t(c);
}

enum class AlphaMode : uint32_t { kOpaque, kMask, kBlend };

struct Material {
    std::string name;
    glm::vec4 baseColor{1};  // linear, factor
    glm::vec3 emissive{0};   // W/(m² sr), factor x KHR_materials_emissive_strength
    float metallic = 1;
    float roughness = 1;
    float specular = 1;  // KHR_materials_specular factor
    float normalScale = 1;
    float alphaCutoff = 0.5f;
    bool coversWholly = false;  // of blended ones: glass whatever its alpha
    float transmission = 0;     // of blended ones: share of what is not reflected that passes, tinted
    AlphaMode alphaMode = AlphaMode::kOpaque;
    bool doubleSided = false;
    bool vertexColors = false;  // its vertices have colours
    bool unlit = false;         // KHR_materials_unlit: shines its colour, and is no light of the scene
    TextureClass textureClass = TextureClass::kNone;
    // Layers in the arrays of the class; -1: none.
    int32_t baseColorLayer = -1;                // in the sRGB array
    int32_t emissiveLayer = -1;                 // in the sRGB array
    int32_t normalLayer = -1;                   // in the linear array
    int32_t metallicRoughnessLayer = -1;        // in the linear array
    glm::mat3x2 uvTransform{1, 0, 0, 1, 0, 0};  // KHR_texture_transform of the base colour, used for all
};

// Texels of one class: layers of size x size RGBA8, ready to upload (mips are made on the device).
struct TextureLayers {
    std::vector<std::vector<uint8_t>> srgb, linear;
};

struct GeometryArrays {  // fixed once loaded
    std::vector<glm::vec3> positions;
    std::vector<VertexAttributes> attributes;
    std::vector<SkinVertex> skin;  // empty, or one a position
    std::vector<uint32_t> indices;
    std::vector<Primitive> primitives;
    std::vector<Material> materials;
    TextureLayers textures[kTextureClassCount];
    uint64_t version = 1;
};

constexpr uint32_t kNoSkinnedMesh = ~0u;
constexpr uint32_t kNoPrimitive = ~0u;

// One drawn primitive. The row's index is its slot on the GPU.
struct RenderInstance {
    glm::mat4x3 worldFromLocal{1};  // relative to the origin
    uint32_t primitive = 0;         // kNoPrimitive: nothing stands in this row now
    bool movable = false;           // others may move too, but then what was made of static things is lost
    uint32_t skinnedMesh =
        kNoSkinnedMesh;  // of RenderScene::skinnedMeshes: its vertices are that one's own; then movable

    bool isPresent() const { return primitive != kNoPrimitive; }
};

// Each skinned mesh's vertices begin at a multiple of this, so that a group of the device has those of one
// only.
constexpr uint32_t kSkinnedMeshAlignment = 64;

// A mesh bent by joints: it has a deformed copy of the mesh's vertices, in the frame of its instances.
struct RenderSkinnedMesh {
    uint32_t firstVertex = 0, vertexCount = 0;  // of GeometryArrays: the mesh as it was modelled
    uint32_t firstDeformed = 0;                 // of all skinned meshes' vertices end to end
    uint32_t firstJoint = 0, jointCount = 0;    // of RenderScene::joints
    Bounds boundsLocal;                         // of the mesh as it is bent
    uint64_t poseVersion = 1;                   // equal numbers mean equal joints
};

struct RenderLight {
    LightKind kind = LightKind::kPoint;
    glm::vec3 position{0};          // m, relative to the origin
    glm::vec3 direction{0, -1, 0};  // the way the light travels, unit
    glm::vec3 intensity{1};         // W/sr; directional: W/m² on a plane facing the light
    float range = 0;                // m, 0: no limit
    float innerConeAngle = 0;       // radians from the axis
    float outerConeAngle = 0.785398f;
    bool bounces = false;          // has a BounceLight: gets an RSM
    bool reflects = false;         // without: its light goes on from points of surfaces, with later bounces
    uint32_t rsmResolution = 512;  // texels of a square map, or of about as many on six faces
    float budgetShare = 1;         // weight of its share of the cluster budget, times its flux
    bool castsShadow = true;
    uint64_t id = 0;  // stable identity (entity handle), for carrying clusters over

    bool operator==(const RenderLight&) const = default;
};

struct RenderScene {
    const GeometryArrays* geometry = nullptr;
    glm::dvec3 originWorld{0};  // m
    std::vector<RenderInstance> instances;
    std::vector<RenderSkinnedMesh> skinnedMeshes;  // who they are changes with all instances
    std::vector<glm::mat3x4>
        joints;  // rows of 3x4 matrices: a skinned mesh's frame from its mesh as modelled
    std::vector<RenderLight> lights;
    std::shared_ptr<const Sky> sky;  // null: black
    std::vector<RenderProbe> probes;
    RenderCamera camera;
    Bounds bounds;  // of all instances

    // Versions: equal numbers mean equal contents. Never 0.
    uint64_t instancesVersion = 1;  // any instance row
    uint64_t lightsVersion = 1;
    uint64_t probesVersion = 1;
    uint64_t cameraVersion = 1;
    uint64_t originVersion = 1;  // the origin moved: histories in world space must be dropped
    // Rows of `instances` that changed since the version before, as half-open ranges; empty with
    // `allInstancesChanged` false means none.
    struct Range {
        uint32_t begin = 0, end = 0;
    };
    std::vector<Range> changedInstances;  // those of a skinned mesh also when its joints moved
    // Among those: rows where something came or went. What stays keeps its row.
    std::vector<Range> replacedInstances;
    bool allInstancesChanged = true;
};

inline const Bounds& boundsLocal(const RenderScene& scene, const RenderInstance& instance) {
    return instance.skinnedMesh == kNoSkinnedMesh ? scene.geometry->primitives[instance.primitive].boundsLocal
                                                  : scene.skinnedMeshes[instance.skinnedMesh].boundsLocal;
}

// The vertex that the primitive's index 0 means: of the geometry, or of all skinned meshes' deformed ones.
inline int32_t firstVertexOf(const RenderScene& scene, uint32_t primitive, uint32_t skinnedMesh) {
    const int32_t offset = scene.geometry->primitives[primitive].vertexOffset;
    if (skinnedMesh == kNoSkinnedMesh) return offset;
    const RenderSkinnedMesh& deformed = scene.skinnedMeshes[skinnedMesh];
    return offset - int32_t(deformed.firstVertex) + int32_t(deformed.firstDeformed);
}

}  // namespace ag
