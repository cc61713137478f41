// A bounding volume hierarchy over boxes, laid out for traversal without a stack: nodes in depth-first order,
// each with the node to go on at when its box is missed.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/core/bounds.h"

namespace ag::gi {

struct BvhNode {
    Bounds bounds;
    uint32_t next = 0;  // node that follows this one's subtree
    uint32_t first = 0,
             count = 0;  // leaf: of Bvh::order; count 0: inner, its first child is the next in the array
};

struct Bvh {
    std::vector<BvhNode> nodes;   // none: there was no item
    std::vector<uint32_t> order;  // items, leaf by leaf
};

// By the surface area heuristic over 16 bins along each axis (Wald 2007). Leaves hold
// at most `leafItems`. The same items give the same tree. Empty boxes are left out.
Bvh buildBvh(std::span<const Bounds> items, uint32_t leafItems);

// Boxes of other items in the same order: those of leaves, and of all above them. Keeps the tree's shape.
void refit(Bvh& bvh, std::span<const Bounds> items);

}  // namespace ag::gi
