// World transforms from local ones: roots where they changed, then children level by level.
#pragma once

#include "engine/ecs/view.h"
#include "engine/scene/components.h"

namespace ag {

void updateRootTransforms(View<Changed<const LocalTransform>, WorldTransform, Without<Parent>> roots);
// Writes a child only if its transform differs: what stands still stays unchanged for everyone after.
void updateChildTransforms(
    View<const LocalTransform, const Parent, const HierarchyDepth, WorldTransform> children,
    Lookup<const WorldTransform> parents, Res<const HierarchyLevels> levels);

}  // namespace ag
