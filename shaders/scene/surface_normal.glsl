// What a fragment's normal map says.
#ifndef AG_SURFACE_NORMAL_GLSL
#define AG_SURFACE_NORMAL_GLSL

#include "common/tangent_frame.h"

// n: the vertices', on the front. Tangents: the file's, or zero.
TangentFrame tangentFrame(SurfaceMaterial m, vec3 position, vec3 n, vec4 tangent) {
    TangentFrame derived = frameOfSteps(n, dFdx(position), dFdy(position), dFdx(m.uv), dFdy(m.uv));
    if (dot(tangent.xyz, tangent.xyz) > 1e-12) return frameOfTangent(n, tangent);
    return derived;
}

vec3 mappedNormal(SurfaceMaterial m) { return sampleLinear(m.uv, m.layers.z).xyz * 2.0 - 1.0; }

// The shading normal. n: as above; seen from behind, all of it is to be turned round.
vec3 bentNormal(SurfaceMaterial m, vec3 position, vec3 n, vec4 tangent) {
    vec3 mapped = mappedNormal(m);
    mapped.xy *= m.normalScale;
    vec3 bent = fromFrame(tangentFrame(m, position, n, tangent), mapped);
    bent = dot(bent, bent) > 1e-12 ? normalize(bent) : n;
    return m.layers.z < 0 ? n : bent;
}
#endif
