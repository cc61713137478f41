// Irradiance probes: points of the game, and the light that falls there.
#ifndef AG_PROBES_IO_H
#define AG_PROBES_IO_H

#include "common/portable.h"

#ifdef __cplusplus
namespace ag::io {
#endif

const float kProbeSphere = 0.25f;  // mean cosine over all directions, of a light in one of them

struct Probe {      // 2 vec4
    vec3 position;  // m
    uint idLow;
    vec3 normal;  // unit; zero: the mean over all directions
    uint idHigh;
    uint before;  // one more than its row in the frame before; 0: it had none
};

struct ProbeRow {  // 2 vec4
    vec3 direct;   // W/m²
    uint idLow;
    vec3 bounced;  // W/m²
    uint idHigh;
};

struct ProbePush {
    uint valCount;
    uint faceCount;    // of the RSMs
    uint ismTileSize;  // texels
};

// What a probe remembers of frames before, W/m².
struct ProbeMeans {
    vec3 byRays;  // means over `frames`, of the same light
    float frames;
    vec3 byLights;
    float still;   // frames since anything changed
    vec3 settled;  // mean by rays over these
};

struct ProbeRaysPush {
    uint valCount;      // with padding
    uint clusterCount;  // those that have members
    uint atlasWidth;    // texels, of the maps
    uint rays;          // of each probe
    uint step;          // number of the frame's rays
    uint known;         // 0: there are no means before
    uint still;         // 1: nothing has changed since the frame before
    // m, and in texels: rays leave and reach surfaces so far before them at least
    float offset, texelOffset;
    // Maps of points that shine and of those that reflect; none: beyond all maps. m: rays to whatever is near
    // find surfaces so near, draws to points on them have those beyond.
    uint emissiveMap, laterMap;
    float emissiveReach, laterReach;
};

#ifdef __cplusplus
}  // namespace ag::io
#endif
#endif
