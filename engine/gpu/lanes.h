// How many invocations the kernels that exchange values work in (shaders/common/lanes.glsl): a subgroup whose
// size is known, or a workgroup that shares memory.
#pragma once

#include <cstdint>

namespace ag::gpu {

constexpr uint32_t kLeastLanes = 4, kMostLanes = 64;

struct Lanes {
    uint32_t count = 32;     // kLeastLanes to kMostLanes, a power of two
    bool shared = false;     // through shared memory: no subgroup has that size for certain
    bool requested = false;  // pipelines ask for subgroups of that size

    bool operator==(const Lanes&) const = default;
};

struct SubgroupSizes {
    uint32_t usual = 0;            // what VkPhysicalDeviceSubgroupProperties says
    uint32_t least = 0, most = 0;  // 0: not known
    bool canBeRequested = false;   // for compute, with full subgroups
};

Lanes chooseLanes(const SubgroupSizes& sizes, bool isCpu);

}  // namespace ag::gpu
