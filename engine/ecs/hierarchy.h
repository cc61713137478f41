// Who hangs on whom: a Parent component and the depth below the root. Systems go level by level by the depth;
// the list of children is derived from the parents, for editing.
#pragma once

#include <span>
#include <vector>

#include "engine/ecs/world.h"

namespace ag {

struct Parent {
    Entity entity;
};
struct HierarchyDepth {
    uint32_t depth = 0;  // 1: child of a root
};
struct HierarchyLevels {  // resource, if the world has it: kept up by setParent
    uint32_t deepest = 0;
};

// Children by parent; brought up to date when asked, if parents changed since.
class ChildIndex {
  public:
    // In storage order. Valid until the next call or change of the world.
    std::span<const Entity> of(const World& world, Entity parent);

  private:
    void refresh(const World& world);
    std::vector<uint32_t> first_;  // of the parent's index, into children_
    std::vector<Entity> children_;
    uint64_t editCount_ = ~uint64_t(0);
    uint32_t version_ = 0;
};

// Hangs `child` and all below it on `parent`; Entity{} makes it a root. Its local transform stays as it is.
// Both must be alive, and the parent not below the child.
void setParent(World& world, ChildIndex& children, Entity child, Entity parent);

// The entity and all below it, each after its parent.
std::vector<Entity> subtree(const World& world, ChildIndex& children, Entity root);
// Returns how many were destroyed. Destroying only the root leaves its children without one, where they
// stand.
uint32_t destroySubtree(World& world, ChildIndex& children, Entity root);

}  // namespace ag
