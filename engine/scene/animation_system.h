// Animations in a world: players go on by ticks, nodes and skinned meshes' joints follow.
#pragma once

#include "engine/ecs/view.h"
#include "engine/scene/components.h"
#include "engine/scene/extract_system.h"
#include "engine/scene/skinned_mesh.h"

namespace ag {

// Of a tick; those at rest are not written.
void advancePlayers(View<AnimationPlayer> players, const SkinnedMeshLibrary& library, float step,
                    JobRunner& runner);

using AnimatedNodes = View<LocalTransform, Changed<const AnimationPlayer>, Without<SkinnedMesh>>;
void animateNodes(AnimatedNodes nodes, Res<const SkinnedMeshLibrary> library, JobRunner& runner);

// Before extractScene: the joints of each skinned mesh whose player moved on.
void poseSkinnedMeshes(SkinnedRows skinnedMeshes, Res<const SkinnedMeshLibrary> library,
                       Res<ExtractState> state, Res<RenderScene> scene, JobRunner& runner);

}  // namespace ag
