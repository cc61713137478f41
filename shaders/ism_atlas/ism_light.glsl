// The place and frame an imperfect shadow map is seen from, and the points in that frame.
#ifndef AG_ISM_LIGHT_GLSL
#define AG_ISM_LIGHT_GLSL

#include "common/sampling.h"
#include "ism_atlas/ism_atlas_io.h"

struct IsmLight {
    vec3 place, normal, t, b;
    bool lit;
};

#define AG_ISM_LIGHT(vals, map) ismLight_(fetchTexel(vals, int(map) * 3).xyz, fetchTexel(vals, int(map) * 3 + 1).xyz, fetchTexel(vals, int(map) * 3 + 2))

// From just before all of the light's own texels (power.w, m), so that it does not stand in its own way.
IsmLight ismLight_(vec3 place, vec3 normal, vec4 power) {
    IsmLight l;
    l.place = place + normal * power.w;
    l.normal = normal;
    l.lit = power.rgb != vec3(0.0);
    orthonormalBasis(l.normal, l.t, l.b);
    return l;
}

vec3 toLight(IsmLight l, vec3 v) { return vec3(dot(v, l.t), dot(v, l.b), dot(v, l.normal)); }

// A chosen point: which one and how many times its own radius its disk has, a half float without its sign.
uint packIsmPoint(uint point, float growth) { return packHalf2x16(vec2(growth, 0.0)) << kIsmPointBits | point; }
uint pointOf(uint packed) { return packed & ((1u << kIsmPointBits) - 1u); }
float growthOf(uint packed) { return unpackHalf2x16(packed >> kIsmPointBits).x; }

// The plane through p with normal n as dot(m, d) = 1; planes through the light itself bound nothing.
vec3 planeThrough(vec3 p, vec3 n) {
    float h = dot(n, p);
    return abs(h) > 1e-4 * length(p) ? n / h : vec3(0.0);
}
#endif
