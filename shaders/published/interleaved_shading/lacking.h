// Pixels that no neighbour gives some parts of the far lights, in lists of one a tile.
#ifndef AG_LACKING_H
#define AG_LACKING_H

#include "common/portable.h"

#ifdef __cplusplus
namespace ag::io {
#endif

// Of a word that says which pixel of a tile lacks parts of its far lights; those parts are the bits above.
const uint kLackingPixelBits = 10;

AG_FUNCTION uint packLacking(uint inTile, uint parts) {
    return parts << kLackingPixelBits | inTile;
}

#ifdef __cplusplus
}  // namespace ag::io
#endif
#endif
