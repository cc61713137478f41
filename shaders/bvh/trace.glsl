// Rays through the occluders' trees, without a stack and without ray-tracing hardware: nodes are met in depth-first
// order, a missed box leads to the node after its subtree. Before: UVEC4_TEXELS treeNodes, moverNodes and treePlaces
// (common/texels.glsl); treeTriangles, a buffer of vec4 (BvhTriangle). What moves is traced with AG_BVH_MOVERS alone;
// without it moverNodes is not needed.
#ifndef AG_BVH_TRACE_GLSL
#define AG_BVH_TRACE_GLSL

#include "bvh/bvh_io.h"

// Of one ray: the nearest hit so far, in lengths of `direction`.
struct BvhRay {
    vec3 origin, direction;
    float reach;
    float opaqueFrom;  // the ray's random number in [0, 1); each masked triangle shifts it by one of its own
    bool any;          // the first hit will do
    int triangle;      // that was met
    uint place;        // of its tree
};

struct BvhGridRay {
    vec3 origin, direction, inverse;
    int node, end;
};

BvhGridRay rayInTree(BvhRay ray, uint place) {
    vec4 x = uintBitsToFloat(fetchTexel(treePlaces, int(place) * 4)), y = uintBitsToFloat(fetchTexel(treePlaces, int(place) * 4 + 1));
    vec4 z = uintBitsToFloat(fetchTexel(treePlaces, int(place) * 4 + 2));
    uvec4 range = fetchTexel(treePlaces, int(place) * 4 + 3);
    vec4 o = vec4(ray.origin, 1.0);
    vec3 d = vec3(dot(x.xyz, ray.direction), dot(y.xyz, ray.direction), dot(z.xyz, ray.direction));
    d = mix(d, vec3(1e-12), lessThan(abs(d), vec3(1e-12)));
    return BvhGridRay(vec3(dot(x, o), dot(y, o), dot(z, o)), d, 1.0 / d, int(range.x), int(range.y));
}

bool meetsBox(BvhGridRay r, uvec4 node, float reach) {
    vec3 low = vec3(node.x & 0xffffu, node.x >> 16, node.y & 0xffffu);
    vec3 high = vec3(node.y >> 16, node.z & 0xffffu, node.z >> 16);
    vec3 a = (low - r.origin) * r.inverse, b = (high - r.origin) * r.inverse;
    vec3 enter = min(a, b), leave = max(a, b);
    return max(max(enter.x, enter.y), max(enter.z, 0.0)) <= min(min(leave.x, leave.y), min(leave.z, reach));
}

// Multiples of the golden ratio: one in [0, 1) for each triangle, unlike its neighbours'.
float drawnFor(int triangle) { return float(uint(triangle) * 0x9e3779b9u >> 8u) / 16777216.0; }

// Whether a ray is stopped where it meets a triangle. A pass may define another rule.
#ifndef AG_BVH_STOPS
#define AG_BVH_STOPS(triangle, opacity, u, v, opaqueFrom) ((opacity) > fract((opaqueFrom) + drawnFor(triangle)))
#endif

// Möller & Trumbore 1997, both sides; the reach, shorter where the triangle is met before.
float meetTriangle(BvhGridRay r, int triangle, float reach, float opaqueFrom) {
    vec4 corner = treeTriangles.items[triangle * 3];
    vec3 edge1 = treeTriangles.items[triangle * 3 + 1].xyz, edge2 = treeTriangles.items[triangle * 3 + 2].xyz;
    vec3 p = cross(r.direction, edge2), s = r.origin - corner.xyz, q = cross(s, edge1);
    float det = dot(edge1, p), inverse = det != 0.0 ? 1.0 / det : 0.0;
    float u = dot(s, p) * inverse, v = dot(r.direction, q) * inverse, t = dot(edge2, q) * inverse;
    const float kSlack = 1e-6;  // no ray slips through where triangles meet
    bool hit = det != 0.0 && min(u, v) >= -kSlack && u + v <= 1.0 + kSlack && t > 0.0 && t < reach;
    return hit && AG_BVH_STOPS(triangle, corner.w, u, v, opaqueFrom) ? t : reach;
}

// Across a triangle of the tree, in the world; of any length.
vec3 triangleNormal(int triangle, uint place) {
    vec3 n = cross(treeTriangles.items[triangle * 3 + 1].xyz, treeTriangles.items[triangle * 3 + 2].xyz);
    vec3 x = uintBitsToFloat(fetchTexel(treePlaces, int(place) * 4).xyz), y = uintBitsToFloat(fetchTexel(treePlaces, int(place) * 4 + 1).xyz);
    vec3 z = uintBitsToFloat(fetchTexel(treePlaces, int(place) * 4 + 2).xyz);
    return x * n.x + y * n.y + z * n.z;
}

#define AG_BVH_NODE_ITEMS(node) int((node).w >> kBvhCountShift & kBvhMostLeafItems)
#define AG_BVH_NODE_FIRST(node) int((node).w & (kBvhMostItems - 1u))

void traceTree(inout BvhRay ray, uint place) {
    BvhGridRay r = rayInTree(ray, place);
    while (r.node < r.end) {
        uvec4 node = uvec4(0);
        bool found = false;
        while (!found && r.node < r.end) {
            node = fetchTexel(treeNodes, r.node);
            bool leaf = node.w >= kBvhLeafBit, met = meetsBox(r, node, ray.reach);
            found = leaf && met;
            r.node = leaf || met ? r.node + 1 : int(node.w);
        }
        if (!found) break;
        float before = ray.reach;
        int first = AG_BVH_NODE_FIRST(node), count = AG_BVH_NODE_ITEMS(node);
        for (int i = 0; i < count; ++i) {
            float reach = meetTriangle(r, first + i, ray.reach, ray.opaqueFrom);
            ray.triangle = reach < ray.reach ? first + i : ray.triangle;
            ray.reach = reach;
        }
        ray.place = ray.reach < before ? place : ray.place;
        if (ray.any && ray.reach < before) return;
    }
}

#ifdef AG_BVH_MOVERS
// Through all that is static and all that moves: whether something is met; then ray.reach is where.
bool traceOccluders(inout BvhRay ray) {
    float before = ray.reach;
    traceTree(ray, kBvhStatic);
    if (ray.any && ray.reach < before) return true;
    BvhGridRay r = rayInTree(ray, kBvhMovers);
    while (r.node < r.end) {
        uvec4 node = fetchTexel(moverNodes, r.node);
        bool leaf = node.w >= kBvhLeafBit, met = meetsBox(r, node, ray.reach);
        if (leaf && met) {
            int first = AG_BVH_NODE_FIRST(node), count = AG_BVH_NODE_ITEMS(node);
            for (int i = 0; i < count; ++i) traceTree(ray, kBvhFirstMover + uint(first + i));
            if (ray.any && ray.reach < before) return true;
        }
        r.node = leaf || met ? r.node + 1 : int(node.w);
    }
    return ray.reach < before;
}
#endif
#endif
