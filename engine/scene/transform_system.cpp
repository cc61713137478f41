#include "engine/scene/transform_system.h"

namespace ag {
namespace {

WorldTransform place(const LocalTransform& local, const WorldTransform& parent) {
    const glm::mat3 r = glm::mat3_cast(local.rotation);
    WorldTransform out;
    out.linear = parent.linear * glm::mat3(r[0] * local.scale.x, r[1] * local.scale.y, r[2] * local.scale.z);
    out.translation = parent.translation + glm::dmat3(parent.linear) * local.translation;
    out.handedness = glm::determinant(out.linear) < 0 ? -1.0f : 1.0f;
    return out;
}

bool update(WorldTransform& world, const WorldTransform& fresh) {
    if (world.translation == fresh.translation && world.linear == fresh.linear) return false;
    world = fresh;
    return true;
}

}  // namespace

void updateRootTransforms(View<Changed<const LocalTransform>, WorldTransform, Without<Parent>> roots) {
    roots.each(
        [](const LocalTransform& local, WorldTransform& world) { return update(world, place(local, {})); });
}

void updateChildTransforms(
    View<const LocalTransform, const Parent, const HierarchyDepth, WorldTransform> children,
    Lookup<const WorldTransform> parents, Res<const HierarchyLevels> levels) {
    for (uint32_t depth = 1; depth <= levels->deepest; ++depth)
        children.each([&](const LocalTransform& local, const Parent& parent, const HierarchyDepth& at,
                          WorldTransform& world) {
            if (at.depth != depth) return false;
            const WorldTransform* above = parents(parent.entity);
            return above && update(world, place(local, *above));
        });
}

}  // namespace ag
