#include "engine/gpu/lanes.h"

#include <algorithm>

namespace ag::gpu {
namespace {

constexpr uint32_t kPreferred = 32;  // fills the lanes of every discrete GPU, and all in flight stay few

bool isPossible(uint32_t size) {
    return size >= kLeastLanes && size <= kMostLanes;
}

}  // namespace

Lanes chooseLanes(const SubgroupSizes& s, bool isCpu) {
    const bool fixed = isCpu || (s.least > 0 && s.least == s.most);  // a CPU's vectors have one width
    if (fixed && isPossible(s.usual)) return {.count = s.usual};
    if (s.canBeRequested && s.least <= kMostLanes && s.most >= kLeastLanes)
        return {.count = std::clamp(kPreferred, std::max(s.least, kLeastLanes), std::min(s.most, kMostLanes)),
                .requested = true};
    return {.count = kPreferred, .shared = true};
}

}  // namespace ag::gpu
