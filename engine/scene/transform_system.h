// World transforms from local ones: roots where they changed, then children level by level.
#pragma once

#include "engine/ecs/view.h"
#include "engine/scene/components.h"

namespace ag {

void updateRootTransforms(View<Changed<const LocalTransform>, WorldTransform, Without<Parent>> roots,
                          JobRunner& runner);

using Children = View<const LocalTransform, const Parent, const HierarchyDepth, WorldTransform>;
// Writes a child only if its transform differs: what stands still stays unchanged for everyone after. A child
// whose parent is gone stays where it is. Nothing is looked at while nothing moves.
void updateChildTransforms(Children children, View<Changed<const LocalTransform>, With<Parent>> moved,
                           View<Changed<const Parent>> hung, View<Changed<const WorldTransform>> parentsMoved,
                           Lookup<const WorldTransform> parents, Res<const HierarchyLevels> levels,
                           JobRunner& runner);

}  // namespace ag
