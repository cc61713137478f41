// A SkinnedSample in the current pose, from the skinned meshes' deformed vertices.
#ifndef AG_SKINNED_SAMPLE_GLSL
#define AG_SKINNED_SAMPLE_GLSL

#include "skinning/skinning_io.h"
#include "surface_points/skinned_sample.h"

SurfaceSample deformedSample(vec3 a, vec3 b, vec3 c, vec3 normalA, vec3 normalB, vec3 normalC, uint instance,
                             vec3 weights, uint sharp) {
    SurfaceSample s = sampleOfTriangle(a, b, c, weights, sharp);
    s.instance = instance;
    s.curvatureLocal = curvatureOfTriangle(a, b, c, normalA, normalB, normalC);
    return s;
}

#define AG_DEFORMED_SAMPLE(positions, rows, instance, weights, corners)                             \
    deformedSample((positions).items[(corners).x], (positions).items[(corners).y],                  \
                   (positions).items[(corners).z], (rows).items[(corners).x].normal,                \
                   (rows).items[(corners).y].normal, (rows).items[(corners).z].normal, instance,    \
                   weights, (corners).w)
#endif
