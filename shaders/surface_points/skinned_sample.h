// A point on a skinned mesh, from the corners of its triangle as they are bent now.
#ifndef AG_SKINNED_SAMPLE_H
#define AG_SKINNED_SAMPLE_H

#include "surface_points/surface_points_io.h"

AG_BEGIN

AG_FUNCTION SurfaceEdge edgeFrom(vec3 point, vec3 normal, vec3 corner, vec3 next) {
    vec3 inward = cross(normal, next - corner);
    SurfaceEdge edge;
    edge.inward = inward * inversesqrt(max(dot(inward, inward), 1e-37f));
    edge.distance = max(dot(point - corner, edge.inward), 0.0f);
    return edge;
}

// The nearer two of what is known and one more.
AG_FUNCTION void noteEdge(AG_INOUT(SurfaceSample) s, SurfaceEdge edge) {
    if (edge.distance < s.edgesLocal[0].distance) {
        s.edgesLocal[1] = s.edgesLocal[0];
        s.edgesLocal[0] = edge;
    } else if (edge.distance < s.edgesLocal[1].distance) {
        s.edgesLocal[1] = edge;
    }
}

// `weights` of the corners a, b, c; `sharp`: kSharp bits.
AG_FUNCTION SurfaceSample sampleOfTriangle(vec3 a, vec3 b, vec3 c, vec3 weights, uint sharp) {
    SurfaceSample s;
    vec3 normal = cross(b - a, c - a);
    s.instance = 0u;
    s.positionLocal = a * weights.x + b * weights.y + c * weights.z;
    s.normalLocal = normal * inversesqrt(max(dot(normal, normal), 1e-37f));
    s.curvatureLocal = 0.0f;
    s.edgesLocal[0].inward = vec3(0.0f);
    s.edgesLocal[0].distance = 1e30f;
    s.edgesLocal[1] = s.edgesLocal[0];
    if ((sharp & 1u) != 0u) noteEdge(s, edgeFrom(s.positionLocal, s.normalLocal, a, b));
    if ((sharp & 2u) != 0u) noteEdge(s, edgeFrom(s.positionLocal, s.normalLocal, b, c));
    if ((sharp & 4u) != 0u) noteEdge(s, edgeFrom(s.positionLocal, s.normalLocal, c, a));
    if ((sharp & kSharpCutOut) != 0u) s.edgesLocal[0].distance = -1.0f;
    return s;
}

// The most that smooth normals turn along a side, over its length.
AG_FUNCTION float curvatureOfTriangle(vec3 a, vec3 b, vec3 c, vec3 normalA, vec3 normalB, vec3 normalC) {
    float ab = length(normalB - normalA) / max(length(b - a), 1e-12f);
    float bc = length(normalC - normalB) / max(length(c - b), 1e-12f);
    float ca = length(normalA - normalC) / max(length(a - c), 1e-12f);
    return max(ab, max(bc, ca));
}

AG_END

#endif
