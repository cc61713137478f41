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

// Of one layer: the static points or those that may move.
struct IsmSplatPush {
    uint pointCount;                // of both layers
    uint firstSegment, endSegment;  // the layer's
    uint tileSize;                  // texels along a map's side
    uint firstEntry, entryCount;    // the layer's among a map's points: the static ones come first
    float diskRadius;               // over that of disks with the surfaces' area together
    float inverseExtent;            // 1/m: of the greatest distance
    uint contents;                  // changes with the static points and with what maps are made like
};

struct IsmPlace {   // what the static layer of a map was last made for
    vec3 position;  // m
    uint contents;  // as above; 0: never made
    vec3 normal;
    float before;  // m
    uint made;     // how many times it was
};

struct IsmMapState {  // of a layer of a map
    uint pointCount;  // to splat; 0 for one that is kept
    uint kept;        // 1: as it was, its light and the points have not moved
};

// Maps are finished by squares of so many texels, those that may look otherwise than they did.
const uint kIsmRegionSide = 16;  // a map of the largest has 8 by 8
const int kIsmWidestHole = 2;    // texels to either side that close one

struct IsmFinish {    // what a map was last finished from
    uint made;        // the number of its static layer
    uint touched[2];  // a bit a region: movable surfaces may show in it
};

#ifdef __cplusplus
}  // namespace ag::io
#endif
#endif
