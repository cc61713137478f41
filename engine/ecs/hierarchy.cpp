#include "engine/ecs/hierarchy.h"

#include <algorithm>

#include "engine/ecs/columns.h"

namespace ag {
namespace {

template <class F>
void forChildren(const World& world, F&& f) {  // f(child, living parent) in storage order
    forRowsOf<Parent>(world, [&](Entity child, const Parent& parent) {
        if (world.alive(parent.entity)) f(child, parent.entity);
    });
}

uint32_t depthOf(const World& world, Entity entity) {
    const HierarchyDepth* at = world.get<HierarchyDepth>(entity);
    return at ? at->depth : 0;
}

bool isBelow(const World& world, Entity entity, Entity above) {
    while (true) {
        if (entity == above) return true;
        const Parent* parent = world.get<Parent>(entity);
        if (!parent) return false;
        entity = parent->entity;
    }
}

void noteDepth(World& world, uint32_t depth) {
    if (HierarchyLevels* levels = world.findResource<HierarchyLevels>())
        levels->deepest = std::max(levels->deepest, depth);
}

}  // namespace

void ChildIndex::refresh(const World& world) {
    const uint32_t version = world.columnVersion(componentId<Parent>());
    if (editCount_ == world.editCount() && version_ == version) return;
    editCount_ = world.editCount();
    version_ = version;
    uint32_t count = 0, indices = 0;
    forChildren(world, [&](Entity, Entity parent) {
        ++count;
        indices = std::max(indices, parent.index + 1);
    });
    // Counted, then dealt out: first_[i] ends as the beginning of parent i's children.
    first_.assign(indices + 2, 0);
    children_.resize(count);
    forChildren(world, [&](Entity, Entity parent) { ++first_[parent.index + 2]; });
    for (size_t i = 2; i < first_.size(); ++i)
        first_[i] += first_[i - 1];
    forChildren(world, [&](Entity child, Entity parent) { children_[first_[parent.index + 1]++] = child; });
}

std::span<const Entity> ChildIndex::of(const World& world, Entity parent) {
    refresh(world);
    if (!world.alive(parent) || size_t(parent.index) + 1 >= first_.size()) return {};
    return std::span(children_).subspan(first_[parent.index],
                                        first_[parent.index + 1] - first_[parent.index]);
}

std::vector<Entity> subtree(const World& world, ChildIndex& children, Entity root) {
    std::vector<Entity> all;
    if (world.alive(root)) all.push_back(root);
    for (size_t i = 0; i < all.size(); ++i) {
        const std::span<const Entity> below = children.of(world, all[i]);
        all.insert(all.end(), below.begin(), below.end());
    }
    return all;
}

uint32_t destroySubtree(World& world, ChildIndex& children, Entity root) {
    const std::vector<Entity> all = subtree(world, children, root);
    world.destroy(all);
    return uint32_t(all.size());
}

void setParent(World& world, ChildIndex& children, Entity child, Entity parent) {
    AG_CHECK(world.alive(child));
    const std::vector<Entity> moved = subtree(world, children, child);
    uint32_t depth = 0;
    if (parent) {
        AG_CHECK(world.alive(parent));
        AG_CHECK_MSG(!isBelow(world, parent, child), "an entity cannot hang below itself");
        depth = depthOf(world, parent) + 1;
        world.add(child, Parent{parent});
        world.add(child, HierarchyDepth{depth});
    } else {
        world.remove<Parent>(child);
        world.remove<HierarchyDepth>(child);
    }
    noteDepth(world, depth);
    for (const Entity entity : std::span(moved).subspan(1)) {  // each after its parent
        const uint32_t at = depthOf(world, world.get<Parent>(entity)->entity) + 1;
        world.add(entity, HierarchyDepth{at});
        noteDepth(world, at);
    }
}

}  // namespace ag
