// The squares of texels that maps are finished by.
#ifndef AG_ISM_REGIONS_GLSL
#define AG_ISM_REGIONS_GLSL

#include "ism_atlas/ism_atlas_io.h"

struct IsmRegion {
    uint map;
    uvec2 first;  // texel of the map
};

// Keys and what they are resolved to lie region after region, row by row in each: what is made together lies together.
uint regionTexel(uint map, uvec2 at, uint tileSize) {
    uvec2 region = at / kIsmRegionSide, within = at % kIsmRegionSide;
    uint first = map * tileSize * tileSize + (region.y * (tileSize / kIsmRegionSide) + region.x) * kIsmRegionSide * kIsmRegionSide;
    return first + within.y * kIsmRegionSide + within.x;
}

uint regionsOf(uint tileSize) { return (tileSize / kIsmRegionSide) * (tileSize / kIsmRegionSide); }

// A listed region by its map, row and column: nothing is divided where each texel asks.
uint packRegion(uint map, uint region, uint tileSize) {
    uint along = tileSize / kIsmRegionSide;
    return map << 6 | region / along << 3 | region % along;
}

IsmRegion regionOf(uint packed) { return IsmRegion(packed >> 6, uvec2(packed & 7u, packed >> 3 & 7u) * kIsmRegionSide); }

uvec2 allRegions(uint tileSize) {
    uint count = regionsOf(tileSize);
    return uvec2(count >= 32 ? ~0u : (1u << count) - 1u, count >= 64 ? ~0u : count > 32 ? (1u << (count - 32)) - 1u : 0u);
}

// Appends each region of the mask to the buffer `listed`, counted by `groups`; maps in any order.
#define AG_LIST_REGIONS(map, mask)                                                                                     \
    uint at = atomicAdd(groups.count.x, bitCount((mask).x) + bitCount((mask).y));                                      \
    for (uint word = 0; word < 2; ++word)                                                                              \
        for (uint bits = (mask)[word]; bits != 0; bits &= bits - 1)                                                    \
            listed.items[at++] = packRegion(map, word * 32 + findLSB(bits), push.p.tileSize);
#endif
