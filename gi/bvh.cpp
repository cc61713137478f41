#include "gi/bvh.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>

#include "gi/morton.h"

namespace ag::gi {
namespace {

constexpr uint32_t kBins = 16;
constexpr float kTraversalCost = 1;  // of a node, in those of an item

float halfArea(const Bounds& b) {
    if (b.empty()) return 0;
    const glm::vec3 s = b.max - b.min;
    return s.x * s.y + s.y * s.z + s.z * s.x;
}

struct Bin {
    Bounds bounds;
    uint32_t count = 0;
};

struct Split {
    uint32_t axis = 0, bin = 0;  // the first bin of the right half; 0: no split is worth it
    float least = 0, scale = 0;  // of the centres along the axis: to bins
    uint32_t binOf(glm::vec3 center) const {
        return std::min(uint32_t(std::max((center[int(axis)] - least) * scale, 0.0f)), kBins - 1);
    }
};

class Builder {
  public:
    Builder(std::span<const Bounds> items, uint32_t leafItems, Bvh& bvh)
        : items_(items), leafItems_(leafItems), bvh_(bvh) {}

    // Of order[first, first + count).
    void build(uint32_t first, uint32_t count) {
        const uint32_t node = uint32_t(bvh_.nodes.size());
        Bounds bounds, centers;
        for (uint32_t i = first; i < first + count; ++i) {
            bounds.add(items_[bvh_.order[i]]);
            centers.add(centerOf(bvh_.order[i]));
        }
        bvh_.nodes.push_back({.bounds = bounds});
        const uint32_t left = count > 1 ? divide(first, count, bounds, centers) : 0;
        if (left == 0) {
            bvh_.nodes[node].first = first;
            bvh_.nodes[node].count = count;
        } else {
            build(first, left);
            build(first + left, count - left);
        }
        bvh_.nodes[node].next = uint32_t(bvh_.nodes.size());
    }

  private:
    glm::vec3 centerOf(uint32_t item) const { return 0.5f * (items_[item].min + items_[item].max); }

    // How many go left; 0: they stay together.
    uint32_t divide(uint32_t first, uint32_t count, const Bounds& bounds, const Bounds& centers) {
        const Split split = bestSplit(first, count, bounds, centers);
        const auto begin = bvh_.order.begin() + first;
        if (split.bin > 0) {
            const auto middle = std::partition(
                begin, begin + count, [&](uint32_t item) { return split.binOf(centerOf(item)) < split.bin; });
            return uint32_t(middle - begin);
        }
        return count > leafItems_ ? count / 2 : 0;
    }

    Split bestSplit(uint32_t first, uint32_t count, const Bounds& bounds, const Bounds& centers) const {
        const float whole = std::max(halfArea(bounds), 1e-30f);
        float least = count > leafItems_ ? 3e38f : float(count) * whole;
        Split best;
        for (uint32_t axis = 0; axis < 3; ++axis) {
            const float width = (centers.max - centers.min)[int(axis)];
            if (!(width > 0)) continue;
            Split split{axis, 0, centers.min[int(axis)], float(kBins) / width};
            const float cost = leastCost(first, count, split) + kTraversalCost * whole;
            if (split.bin > 0 && cost < least) least = cost, best = split;
        }
        return best;
    }

    // Of the halves that a split along its axis makes; chooses the bin.
    float leastCost(uint32_t first, uint32_t count, Split& split) const {
        std::array<Bin, kBins> bins;
        for (uint32_t i = first; i < first + count; ++i) {
            Bin& bin = bins[split.binOf(centerOf(bvh_.order[i]))];
            bin.bounds.add(items_[bvh_.order[i]]);
            ++bin.count;
        }
        std::array<float, kBins> rightCost{};
        Bin right, left;
        for (uint32_t b = kBins - 1; b > 0; --b) {
            right.bounds.add(bins[b].bounds);
            right.count += bins[b].count;
            rightCost[b] = halfArea(right.bounds) * float(right.count);
        }
        float least = 3e38f;
        for (uint32_t b = 1; b < kBins; ++b) {
            left.bounds.add(bins[b - 1].bounds);
            left.count += bins[b - 1].count;
            if (left.count == 0 || left.count == count) continue;
            const float cost = halfArea(left.bounds) * float(left.count) + rightCost[b];
            if (cost < least) least = cost, split.bin = b;
        }
        return least;
    }

    std::span<const Bounds> items_;
    uint32_t leafItems_;
    Bvh& bvh_;
};

struct CurvePlace {
    uint32_t code, item;
};

// By codes of 30 bits; equal ones stay in their order. Digit by digit: thrice as fast as comparing, of
// 10,000.
void sortAlongCurve(std::vector<CurvePlace>& places, std::vector<CurvePlace>& sorted) {
    constexpr uint32_t kDigitBits = 10, kDigits = 1u << kDigitBits;
    sorted.resize(places.size());
    for (uint32_t shift = 0; shift < 30; shift += kDigitBits) {
        const auto digitOf = [&](const CurvePlace& p) { return p.code >> shift & (kDigits - 1); };
        std::array<uint32_t, kDigits + 1> first{};
        for (const CurvePlace& p : places)
            ++first[digitOf(p) + 1];
        std::partial_sum(first.begin(), first.end(), first.begin());
        for (const CurvePlace& p : places)
            sorted[first[digitOf(p)]++] = p;
        std::swap(places, sorted);
    }
}

// Leaves of one item, halves where the curve's codes first differ.
class CurveBuilder {
  public:
    CurveBuilder(std::span<const Bounds> items, std::span<const CurvePlace> places, Bvh& bvh)
        : items_(items), places_(places), bvh_(bvh) {}

    Bounds build(uint32_t first, uint32_t count) {
        const auto node = uint32_t(bvh_.nodes.size());
        bvh_.nodes.emplace_back();
        Bounds bounds;
        if (count == 1) {
            bounds = items_[places_[first].item];
            bvh_.nodes[node].first = first;
            bvh_.nodes[node].count = 1;
        } else {
            const uint32_t left = divide(first, count);
            bounds = build(first, left);
            bounds.add(build(first + left, count - left));
        }
        bvh_.nodes[node].bounds = bounds;
        bvh_.nodes[node].next = uint32_t(bvh_.nodes.size());
        return bounds;
    }

  private:
    uint32_t divide(uint32_t first, uint32_t count) const {
        const uint32_t differs = places_[first].code ^ places_[first + count - 1].code;
        if (differs == 0) return count / 2;
        const uint32_t bit = std::bit_floor(differs);
        const auto range = places_.subspan(first, count);
        const auto right =
            std::ranges::partition_point(range, [&](const CurvePlace& p) { return !(p.code & bit); });
        return uint32_t(right - range.begin());
    }

    std::span<const Bounds> items_;
    std::span<const CurvePlace> places_;
    Bvh& bvh_;
};

// Those that are neither empty nor beyond all numbers.
void findSound(std::span<const Bounds> items, std::vector<uint32_t>& sound) {
    sound.clear();
    for (uint32_t i = 0; i < items.size(); ++i)
        if (!items[i].empty() && std::isfinite(glm::dot(items[i].min, items[i].min) + halfArea(items[i])))
            sound.push_back(i);
}

}  // namespace

void buildBvhAlongCurve(std::span<const Bounds> items, Bvh& bvh) {
    static thread_local std::vector<CurvePlace> places, sorted;  // keep their memory
    findSound(items, bvh.order);
    bvh.nodes.clear();
    if (bvh.order.empty()) return;
    Bounds all;
    for (const uint32_t i : bvh.order)
        all.add(items[i]);
    places.clear();
    for (const uint32_t i : bvh.order)
        places.push_back({mortonCode(0.5f * (items[i].min + items[i].max), all), i});
    sortAlongCurve(places, sorted);
    bvh.nodes.reserve(2 * places.size());
    CurveBuilder(items, places, bvh).build(0, uint32_t(places.size()));
    for (size_t i = 0; i < places.size(); ++i)
        bvh.order[i] = places[i].item;
}

void buildBvh(std::span<const Bounds> items, uint32_t leafItems, Bvh& bvh) {
    findSound(items, bvh.order);
    bvh.nodes.clear();
    if (bvh.order.empty()) return;
    bvh.nodes.reserve(2 * bvh.order.size());
    Builder(items, leafItems, bvh).build(0, uint32_t(bvh.order.size()));
}

Bvh buildBvh(std::span<const Bounds> items, uint32_t leafItems) {
    Bvh bvh;
    buildBvh(items, leafItems, bvh);
    return bvh;
}

}  // namespace ag::gi
