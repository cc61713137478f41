// What a ray met. Before: treeTriangles, the trees and bvh/trace.glsl.
#ifndef AG_MET_GLSL
#define AG_MET_GLSL

#include "common/near_share.glsl"

struct Met {
    vec3 place, normal;  // on the ray's side, unit
    bool front;          // it reflects light to where the ray came from
    vec3 reflectance;    // 0 of a triangle that shines
    bool masked;
    vec3 shines;         // W/m²
};

Met surfaceMet(BvhRay ray) {
    vec3 normal = normalize(triangleNormal(ray.triangle, ray.place));
    float front = treeTriangles.items[ray.triangle * 3 + 2].w, sends = treeTriangles.items[ray.triangle * 3 + 1].w;
    bool shines = front >= kEmissiveFront - 1.0;
    front -= shines ? kEmissiveFront : 0.0;
    bool behind = dot(normal, ray.direction) > 0.0;
    bool whole = treeTriangles.items[ray.triangle * 3].w >= 1.0;
    return Met(ray.origin + ray.direction * ray.reach, behind ? -normal : normal, front == 0.0 || (front < 0.0) == behind,
               shines ? vec3(0.0) : unpackReflectance(sends), !whole, shines ? unpackRadiance(sends) * kPi : vec3(0.0));
}
#endif
