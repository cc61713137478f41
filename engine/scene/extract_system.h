// World to RenderScene: the one place where entities become what the renderer sees. Versions move only when
// contents do. The render origin follows the camera in steps of 1,024 m, so that single precision is always
// near.
#pragma once

#include <unordered_set>

#include "engine/ecs/view.h"
#include "engine/scene/components.h"
#include "engine/scene/static_scene.h"

namespace ag {

struct ActiveCamera {  // resource: what the player looks through
    CameraPose pose;
    glm::uvec2 size{640, 360};  // pixels
};

struct ExtractState {                     // resource: which entity each row stands for
    std::vector<Entity> rows;             // entity of each instance row
    std::vector<Entity> seen;             // scratch
    uint32_t entityCount = 0;             // instances at the last look
    bool placed = false;                  // the origin was chosen
    std::unordered_set<uint64_t> warned;  // bits of lights that something is wrong with
};

using InstanceView = View<const WorldTransform, const MeshInstance>;
using ChangedInstances = View<Changed<const WorldTransform>, const MeshInstance>;
using LightRows = View<const WorldTransform, const PunctualLight>;

void extractScene(InstanceView instances, ChangedInstances changed, LightRows lights,
                  Lookup<const BounceLight> bounces, Lookup<const Name> names, Res<const ActiveCamera> camera,
                  Res<ExtractState> state, Res<RenderScene> scene);

}  // namespace ag
