// Virtual area lights: what shading reads of a cluster.
#ifndef AG_VAL_FIT_IO_H
#define AG_VAL_FIT_IO_H

#include "common/portable.h"

#ifdef __cplusplus
namespace ag::io {
#endif

struct Val {        // 3 vec4; black lights pad the list to whole subgroups
    vec3 position;  // m
    float area;     // m²
    vec3 normal;    // unit
    float radius;   // of the disk of that area, m
    vec3 flux;      // W
    float texelCount;
};

struct ValShapeVectors {  // 2 vec4: the rectangle of the cluster's second moments
    vec3 halfU;           // m, in the light's plane
    float inverseArea;    // 1/m²
    vec3 halfV;
    float unused;
};

#ifdef __cplusplus
}  // namespace ag::io
#endif
#endif
