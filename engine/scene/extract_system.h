// World to RenderScene: the one place where entities become what the renderer sees. Versions move only when
// contents do. The render origin follows the camera in rare steps, so that single precision is always near.
#pragma once

#include <unordered_set>

#include "engine/ecs/view.h"
#include "engine/scene/components.h"
#include "engine/scene/instance_bounds.h"
#include "engine/scene/static_scene.h"

namespace ag {

struct ActiveCamera {  // resource: what the player looks through
    CameraPose pose;
    glm::uvec2 size{640, 360};  // pixels
};

// Which instance rows belong to which entity: its primitives in a row, the same ones as long as it lives.
struct InstanceRows {
    struct Place {
        uint32_t generation = ~0u, first = 0, count = 0;
        uint32_t look = 0;  // when it was seen last
    };
    std::vector<Place> ofEntity;              // by Entity::index
    std::vector<Entity> entities;             // that have rows
    std::vector<std::vector<uint32_t>> free;  // first rows of those who left, by their count
    uint32_t end = 0;                         // of all rows
    uint32_t look = 0;

    const Place& of(Entity entity) const { return ofEntity[entity.index]; }
};

struct PosedSkinnedMesh {  // as it was posed last
    Entity entity;
    uint32_t model = 0;
    int32_t clip = -1;
    float seconds = 0;
    bool operator==(const PosedSkinnedMesh&) const = default;
};

struct ExtractState {  // resource: what was seen at the last look
    InstanceRows rows;
    std::vector<Entity> arrived;              // scratch: without rows yet
    std::vector<uint64_t> changed, replaced;  // a bit an instance row
    InstanceBounds bounds;
    bool placed = false;                  // the origin was chosen
    std::unordered_set<uint64_t> warned;  // bits of lights that something is wrong with
    // By poseSkinnedMeshes, in storage order
    std::vector<PosedSkinnedMesh> skinnedMeshes;
    std::vector<uint8_t> poseChanged;    // 1: the skinned mesh's joints moved since the last look
    bool skinnedMeshesReplaced = false;  // others came or went
};

using InstanceView = View<const WorldTransform, const MeshInstance>;
using MovedInstances = View<Taken<const WorldTransform>, const MeshInstance>;
using ChangedMeshes = View<Changed<const MeshInstance>, With<WorldTransform>>;
using SkinnedRows = View<const SkinnedMesh, const AnimationPlayer, const MeshInstance>;
using LightRows = View<const WorldTransform, const PunctualLight>;

void extractScene(InstanceView instances, MovedInstances moved, ChangedMeshes meshes,
                  SkinnedRows skinnedMeshes, LightRows lights, Lookup<const BounceLight> bounces,
                  Lookup<const Name> names, Res<const ActiveCamera> camera, Res<ExtractState> state,
                  Res<RenderScene> scene, JobRunner& runner);

}  // namespace ag
