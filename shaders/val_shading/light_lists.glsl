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

// Of all lights: the near ones, the far ones, then the rest (sort_lights.glsl).
uint listEntry(uint tile, uint entry, uvec2 count, uint valCount) {
    uint near = listStart(tile, kNearList, valCount), far = listStart(tile, kFarList, valCount);
    uint ofRest = near + valCount - 1 - (entry - count.x - count.y);
    return entry < count.x ? near + entry : entry < count.x + count.y ? far + entry - count.x : ofRest;
}
#endif
