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
    // Of a leaf, in Bvh::order. Count 0: an inner node, whose first child is the next in the array.
    uint32_t first = 0, count = 0;
};

struct Bvh {
    std::vector<BvhNode> nodes;   // none: there was no item
    std::vector<uint32_t> order;  // items, leaf by leaf
};

// By the surface area heuristic over 16 bins along each axis (Wald 2007). Leaves hold at most `leafItems`.
// The same items give the same tree. Boxes that are empty or not finite are left out.
Bvh buildBvh(std::span<const Bounds> items, uint32_t leafItems);
void buildBvh(std::span<const Bounds> items, uint32_t leafItems, Bvh& bvh);  // whose memory is used again
// With one item a leaf, along a curve through the boxes' middles (Lauterbach et al. 2009): a tenth of the
// work for a tree that costs rays a little more.
void buildBvhAlongCurve(std::span<const Bounds> items, Bvh& bvh);  // the same

}  // namespace ag::gi
