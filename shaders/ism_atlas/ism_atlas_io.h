// Imperfect shadow maps: one small square map a virtual light, of the hemisphere before it. A texel holds the
// plane of the nearest surface: m with dot(m, d) = 1 for offsets d from the light to its points, in the
// light's frame, and the distance in w (0: nothing was met). What lies beyond the plane is in shadow.
#ifndef AG_ISM_ATLAS_IO_H
#define AG_ISM_ATLAS_IO_H

#include "common/portable.h"

#ifdef __cplusplus
namespace ag::io {
#endif

const uint kMaxIsms = 1024;

// Half the side of a texel of 2 pi / size², times size; rad, or over the distance.
const float kIsmHalfTexel = 1.2533141f;

// A splat's key: distance above, point below, so that the least key is the nearest point's. The distance is 4
// bits of octave and 11 of mantissa below the greatest distance.
const uint kIsmPointBits = 17;
const uint kIsmNoPoint = 0xffffffffu;

// Of one layer: the points that stand still or those that may move.
struct IsmSplatPush {
    uint pointCount;                // of both layers
    uint firstSegment, endSegment;  // the layer's
    uint tileSize;                  // texels along a map's side
    uint pointsPerMap;              // of both layers
    uint firstEntry, entryCount;    // the layer's among them
    float diskRadius;               // over that of disks with the surfaces' area together
    float inverseExtent;            // 1/m: of the greatest distance
    uint contents;                  // changes with the still points and with what maps are made like
};

struct IsmPlace {   // 2 vec4: what a map was last made for
    vec3 position;  // m
    uint contents;  // as above; 0: never made
    vec3 normal;
    float before;  // m
};

struct IsmMapState {  // of a layer of a map
    uint pointCount;  // to splat; 0 for one that is kept
    uint kept;        // 1: as it was, its light and the points have not moved
};

struct IsmLevelPush {
    uint coarseSize;                // texels along the coarser level's tile
    uint fineOffset, coarseOffset;  // first texel of the levels in the pyramid
};

#ifdef __cplusplus
}  // namespace ag::io
#endif
#endif
