// Irradiance probes: points of the game, and the light that falls there.
#ifndef AG_PROBES_IO_H
#define AG_PROBES_IO_H

#include "common/portable.h"

#ifdef __cplusplus
namespace ag::io {
#endif

struct Probe {      // 2 vec4
    vec3 position;  // m
    uint idLow;
    vec3 normal;  // unit; zero: the mean over all directions
    uint idHigh;
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

#ifdef __cplusplus
}  // namespace ag::io
#endif
#endif
