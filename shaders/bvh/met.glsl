// What a ray met. Before: treeTriangles, the trees and bvh/trace.glsl.
#ifndef AG_MET_GLSL
#define AG_MET_GLSL

#include "common/near_share.glsl"

struct Met {
    vec3 place, normal;  // on the ray's side, unit
    bool front;          // it reflects light to where the ray came from
    vec3 reflectance;
    bool masked;
    vec3 shines;         // W/m²
};

Met surfaceMet(BvhRay ray) {
    vec3 normal = normalize(triangleNormal(ray.triangle, ray.place));
    float reflects = treeTriangles.items[ray.triangle * 3 + 1].w, shines = treeTriangles.items[ray.triangle * 3 + 2].w;
    float front = frontOf(reflects, shines);
    bool behind = dot(normal, ray.direction) > 0.0;
    bool whole = treeTriangles.items[ray.triangle * 3].w >= 1.0;
    return Met(ray.origin + ray.direction * ray.reach, behind ? -normal : normal, front == 0.0 || (front < 0.0) == behind,
               reflectanceOf(reflects), !whole, radianceOf(shines) * kPi);
}
#endif
