// Gathering virtual lights. The screen is cut into square tiles; each sorts the lights into near ones, far
// ones, and those that do not reach it.
#ifndef AG_VAL_SHADING_IO_H
#define AG_VAL_SHADING_IO_H

#include "common/portable.h"

#ifdef __cplusplus
namespace ag::io {
#endif

const uint kNearList = 0, kFarList = 1, kLightLists = 2;

struct ValShadingPush {
    uint valCount;  // and so the most entries of a list
    uint firstVal;  // those before it are left alone
    uint tileSize;  // pixels, even
    uvec2 tiles;
    float nearReach;  // lights nearer than this many of their half lengths are near
    uint ismTileSize;
};

struct ValSharePush {
    ValShadingPush gather;
    uint index, count;  // of every count-th tile the index-th ones
};

#ifdef __cplusplus
}  // namespace ag::io
#endif
#endif
