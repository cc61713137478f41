// Trees of boxes: every item in one leaf, every box within its parent's, and a walk without a stack that
// meets what a look at all items meets.
#include "gi/bvh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace ag::gi {
namespace {

std::vector<Bounds> randomBoxes(uint32_t count, uint32_t seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> place(-10, 10), size(0, 0.5f);
    std::vector<Bounds> boxes(count);
    for (Bounds& box : boxes) {
        box.add({place(random), place(random), place(random)});
        box.add(box.min + glm::vec3(size(random), size(random), size(random)));
    }
    return boxes;
}

bool overlaps(const Bounds& a, const Bounds& b) {
    return glm::all(glm::lessThanEqual(a.min, b.max)) && glm::all(glm::lessThanEqual(b.min, a.max));
}

std::vector<uint32_t> found(const Bvh& bvh, std::span<const Bounds> items, const Bounds& in) {
    std::vector<uint32_t> result;
    for (uint32_t n = 0; n < bvh.nodes.size();) {
        const BvhNode& node = bvh.nodes[n];
        const bool met = overlaps(node.bounds, in);
        for (uint32_t i = 0; met && i < node.count; ++i)
            if (overlaps(items[bvh.order[node.first + i]], in)) result.push_back(bvh.order[node.first + i]);
        n = met ? n + 1 : node.next;
    }
    std::ranges::sort(result);
    return result;
}

std::vector<uint32_t> foundWithout(std::span<const Bounds> items, const Bounds& in) {
    std::vector<uint32_t> result;
    for (uint32_t i = 0; i < items.size(); ++i)
        if (overlaps(items[i], in)) result.push_back(i);
    return result;
}

TEST(Bvh, FindsWhatLookingAtAllFinds) {
    const std::vector<Bounds> items = randomBoxes(1000, 1);
    const Bvh bvh = buildBvh(items, 4);
    EXPECT_EQ(bvh.order.size(), items.size());
    EXPECT_EQ(bvh.nodes[0].next, bvh.nodes.size());
    for (const BvhNode& node : bvh.nodes)
        EXPECT_LE(node.count, 4u);
    for (const Bounds& in : randomBoxes(200, 2))
        EXPECT_EQ(found(bvh, items, in), foundWithout(items, in));
}

TEST(Bvh, AlongACurveFindsTheSame) {
    std::vector<Bounds> items = randomBoxes(1000, 1);
    items[7] = {};
    for (size_t i = 20; i < 40; ++i)
        items[i] = items[19];  // no code tells them apart
    Bvh bvh;
    buildBvhAlongCurve(items, bvh);
    EXPECT_EQ(bvh.order.size(), items.size() - 1);
    EXPECT_EQ(bvh.nodes.size(), 2 * bvh.order.size() - 1);
    EXPECT_EQ(bvh.nodes[0].next, bvh.nodes.size());
    const auto same = std::ranges::find(bvh.order, 19u);
    for (uint32_t i = 0; i <= 20; ++i)
        EXPECT_EQ(same[i], 19 + i) << "equal codes stay in their order";
    for (const Bounds& in : randomBoxes(200, 2))
        EXPECT_EQ(found(bvh, items, in), foundWithout(items, in));
    buildBvhAlongCurve({}, bvh);
    EXPECT_TRUE(bvh.nodes.empty());
}

TEST(Bvh, TakesItemsInOnePlaceAndNone) {
    EXPECT_TRUE(buildBvh({}, 4).nodes.empty());
    std::vector<Bounds> items(100);
    EXPECT_TRUE(buildBvh(items, 4).nodes.empty());  // all empty
    for (Bounds& box : items)
        box.add(glm::vec3(1));
    const Bvh bvh = buildBvh(items, 4);
    EXPECT_EQ(found(bvh, items, items[0]).size(), 100u);
    EXPECT_EQ(buildBvh(items, 4).order, bvh.order);
}

}  // namespace
}  // namespace ag::gi
