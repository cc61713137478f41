// Where a tile's list of near or far lights begins.
#ifndef AG_LIGHT_LISTS_GLSL
#define AG_LIGHT_LISTS_GLSL

#include "val_shading/val_shading_io.h"

// Lets the light l of each entry of a list meet what `meet` says. Needs `lists` and area_light.glsl.
#define AG_MEET_LIGHTS(start, count, meet)                                                                                \
    if (kLaneParallel) {                                                                                                  \
        for (uint base = 0; base < (count); base += kSubgroupSize) {                                                      \
            uint entry = (start) + min(base + gl_SubgroupInvocationID, (count) - 1), here = min(kSubgroupSize, (count) - base); \
            AreaLight mine = loadLight(fetchTexel(lists, int(entry)).x);                                                  \
            [[dont_unroll]] for (uint lane = 0; lane < here; ++lane) {                                                    \
                AreaLight l = lightOfLane(mine, lane);                                                                    \
                meet;                                                                                                     \
            }                                                                                                             \
        }                                                                                                                 \
    } else {                                                                                                              \
        for (uint i = 0; i < (count); ++i) {                                                                              \
            AreaLight l = loadLight(fetchTexel(lists, int((start) + i)).x);                                               \
            meet;                                                                                                         \
        }                                                                                                                 \
    }

uint listStart(uint tile, uint list, uint valCount) { return (tile * kLightLists + list) * valCount; }

// Of both lists together, near lights first.
uint listEntry(uint tile, uint entry, uint nearCount, uint valCount) {
    return entry < nearCount ? listStart(tile, kNearList, valCount) + entry
                             : listStart(tile, kFarList, valCount) + entry - nearCount;
}
#endif
