// Components of things in a scene. Plain structs without padding, a unit on every field.
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include "engine/ecs/hierarchy.h"
#include "engine/ecs/name.h"
#include "engine/scene/render_scene.h"

namespace ag {

struct LocalTransform {         // relative to the parent
    glm::dvec3 translation{0};  // m
    glm::quat rotation{1, 0, 0, 0};
    glm::vec3 scale{1};
    uint32_t node = ~0u;  // of the asset it came from
};

struct WorldTransform {         // derived by the transform systems
    glm::dvec3 translation{0};  // m
    glm::mat3 linear{1};        // rotation and scale
    float handedness = 1;       // -1 where a mirrored scale turns triangles over
};
template <>
inline constexpr bool kTrackRows<WorldTransform> = true;

struct MeshInstance {
    uint32_t firstPrimitive = 0, primitiveCount = 0;
    uint32_t movable = 0;  // 1: its transform changes while the level runs; what is static is kept then
};

// A mesh bent by joints, beside a MeshInstance that is movable and an AnimationPlayer.
struct SkinnedMesh {
    uint32_t model = 0;  // of the SkinnedMeshLibrary
};

// Plays an animation of the asset: on a skinned mesh for its joints, elsewhere for the entity's own node.
struct AnimationPlayer {
    int32_t clip = 0;   // the animation; -1: none, a skinned mesh is at rest
    float seconds = 0;  // since its start
    float speed = 1;    // times its own; 0: holds
    uint32_t loops = 1;
};

struct PunctualLight {         // shines along -Z
    glm::vec3 intensity{1};    // W/sr; directional: W/m²
    float range = 0;           // m, 0: none
    float innerConeAngle = 0;  // radians
    float outerConeAngle = 0.785398f;
    LightKind kind = LightKind::kPoint;
    uint32_t castsShadow = 1;
};

// Gives a light an RSM and a share of the clusters.
struct BounceLight {
    uint32_t rsmResolution = 512;  // texels
    float budgetShare = 1;         // weight beside other lights of the same flux
};

}  // namespace ag
