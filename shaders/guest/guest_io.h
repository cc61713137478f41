// What a host's images and triangles need to become ours.
#ifndef AG_GUEST_IO_H
#define AG_GUEST_IO_H

#include "common/portable.h"

#ifdef __cplusplus
namespace ag::io {
#endif

struct ReadSurfacesPush {
    float depthScale, depthOffset;  // of the host's depth, to ours: near / distance
    float farthest;                 // the host's depth of where nothing is
};

struct GuestRsmPush {
    mat4 clipFromWorld;
    vec3 albedo;
    float alphaCutoff;  // 0: none
    uint doubleSided;
    uint mapped;  // albedo is times the map's
};

#ifdef __cplusplus
}  // namespace ag::io
#endif
#endif
