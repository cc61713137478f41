// Virtual area lights: what shading reads of a cluster.
#ifndef AG_VAL_FIT_IO_H
#define AG_VAL_FIT_IO_H

#include "common/portable.h"

#ifdef __cplusplus
namespace ag::io {
#endif

struct Val {          // 3 vec4; black lights pad the list to whole subgroups
    vec3 position;    // m
    float area;       // m²
    vec3 normal;      // unit
    float thickness;  // m, deviation of its texels from the plane, by flux; below 0 where it bulges
    vec3 flux;        // W
    float before;     // m, its texels reach before the plane through the centre
};

const uint kValCorners = 8;

// 7 vec4. Points of light that share maps of visibility: in halfU and halfV the place and the normal a map is
// seen from, in inverseRectangle which one.
struct ValShapeVectors {
    vec3 halfU;              // m, of the rectangle of the cluster's second moments, in the light's plane
    float inverseRectangle;  // 1/m²
    vec3 halfV;
    float inversePolygon;       // 1/m²
    vec2 corners[kValCorners];  // m, of the convex polygon along orthonormalBasis(normal), counter-clockwise
    vec4 gradient;  // of the polygon's radiosity over its mean: slope [1/m] in the same axes, value at the
                    // centre; the polygon's mean second moment [m²]
};

const uint kValShapeVec4s = 7;

// Rays from a cluster's texels, the nearest and the extremes, to two places.
const uint kSightTexels = 9;
const uint kSightOfMiddle = 0, kSightOfPlace = 1, kSightPlaces = 2;

struct ValFitPush {
    uint clusterCount;
    uint valCount;  // with padding
    uint atlasWidth;
    uint known;    // 1: there are lights of the step before
    float offset;  // m, of rays from surfaces
};

#ifdef __cplusplus
}  // namespace ag::io
#endif
#endif
