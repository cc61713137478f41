// Importance of RSM blocks for seeding clusters, kept as one 2x2 sum pyramid a face in Morton order.
#ifndef AG_IMPORTANCE_IO_H
#define AG_IMPORTANCE_IO_H

#include "common/portable.h"
#include "gbuffer/view_points_io.h"

#ifdef __cplusplus
namespace ag::io {
#endif

const uint kLeastBlock = 4;           // texels along a block's side
const uint kMostBlocks = 64;          // along a face's side
const uint kSeedingViewPoints = 256;  // for the view term of seeding (RSMC: 256)

struct ImportanceSettings {  // push constants
    uvec2 atlasSize;         // texels
    uint faceCount;
    uint pyramidStride;  // floats a face
    float viewWeight;    // w_v of ACRSM eq. 4.3, 0: flux alone
};

// Along a side of a face so large: its blocks, and the texels of each.
AG_FUNCTION uint blocksAlong(uint faceSize) {
    return min(faceSize / kLeastBlock, kMostBlocks);
}
AG_FUNCTION uint blockSide(uint faceSize) {
    return faceSize / blocksAlong(faceSize);
}

#ifdef __cplusplus
}  // namespace ag::io
#endif
#endif
