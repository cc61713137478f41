#include "engine/scene/transform_system.h"

namespace ag {
namespace {

glm::mat3 linearOf(const LocalTransform& local) {
    const glm::mat3 r = glm::mat3_cast(local.rotation);
    return {r[0] * local.scale.x, r[1] * local.scale.y, r[2] * local.scale.z};
}

WorldTransform place(const LocalTransform& local) {
    const bool mirrored = local.scale.x * local.scale.y * local.scale.z < 0;
    return {local.translation, linearOf(local), mirrored ? -1.0f : 1.0f};
}

WorldTransform place(const LocalTransform& local, const WorldTransform& parent) {
    WorldTransform out;
    out.linear = parent.linear * linearOf(local);
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

void updateRootTransforms(View<Changed<const LocalTransform>, WorldTransform, Without<Parent>> roots,
                          JobRunner& runner) {
    roots.parallel(runner, [](const LocalTransform& local, WorldTransform& world) {
        return update(world, place(local));
    });
}

void updateChildTransforms(Children children, View<Changed<const LocalTransform>, With<Parent>> moved,
                           View<Changed<const Parent>> hung, View<Changed<const WorldTransform>> parentsMoved,
                           Lookup<const WorldTransform> parents, Res<const HierarchyLevels> levels,
                           JobRunner& runner) {
    if (levels->deepest == 0 || (moved.empty() && hung.empty() && parentsMoved.empty())) return;
    for (uint32_t depth = 1; depth <= levels->deepest; ++depth)
        children.parallel(runner, [&](const LocalTransform& local, const Parent& parent,
                                      const HierarchyDepth& at, WorldTransform& world) {
            if (at.depth != depth) return false;
            const WorldTransform* above = parents(parent.entity);
            return above && update(world, place(local, *above));
        });
}

}  // namespace ag
