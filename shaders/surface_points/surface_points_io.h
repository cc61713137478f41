// Points on the scene's surfaces, to stand for them in small shadow maps.
#ifndef AG_SURFACE_POINTS_IO_H
#define AG_SURFACE_POINTS_IO_H

#include "common/portable.h"

#ifdef __cplusplus
namespace ag::io {
#endif

struct SurfaceEdge {  // where a flat piece of surface ends, seen from a point on it
    vec3 inward;      // unit, in the surface, away from the edge; zero: no end
    float distance;   // m; negative: the surface is cut out at the point, it stands for nothing
};

const uint kNoInstance = ~0u;

struct SurfaceSample {  // 4 vec4: where on which instance, moving with it
    vec3 positionLocal;
    uint instance;         // kNoInstance: there is no point here now
    vec3 normalLocal;      // unit, of the triangle
    float curvatureLocal;  // 1/m: how fast the smooth normal turns along the triangle
    SurfaceEdge edgesLocal[2];
};

// In the place of the first half of a SurfaceSample whose instance is a skinned mesh's.
struct SkinnedSample {
    vec3 weights;  // of the triangle's corners
    uint instance;
    uvec4 corners;  // x, y, z: of all skinned meshes' deformed vertices; w: bit i: the edge from corner i is
                    // sharp
};
const uint kSharpCutOut = 8u;  // among corners.w: an alpha-masked surface is cut out at the point

struct SurfacePoint {  // 4 vec4
    vec3 position;     // m
    float curvature;   // 1/m
    vec3 normal;       // unit
    float radius;      // m, of a disk as large as what it stands for; 0: there is no point
    SurfaceEdge edges[2];
};

// Points lie along a curve through all surfaces; so many in a row make a segment.
const uint kSegmentPoints = 64;

struct SurfaceSegment {  // 1 vec4: a ball round a segment's points
    vec3 centre;         // m
    uint radiusAndArea;  // halves, m and m²: of the ball, and what the points stand for
};

struct PointPush {
    uint firstGroup;  // to run
    uint pointCount;  // of all
};

#ifdef __cplusplus
}  // namespace ag::io
#endif
#endif
