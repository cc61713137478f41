// Shadows by a ray. Trees know the mean opacity of masked triangles alone: where nothing else is in the way, a shadow map is to
// be asked. Needs buffer `camera`.
#ifndef AG_TRACED_SHADOW_GLSL
#define AG_TRACED_SHADOW_GLSL

#include "common/texels.glsl"

layout(set = 0, binding = 20) UVEC4_TEXELS(treeNodes);
layout(set = 0, binding = 21) UVEC4_TEXELS(moverNodes);
layout(set = 0, binding = 22) UVEC4_TEXELS(treePlaces);
layout(set = 0, binding = 23, scalar) readonly buffer TreeTriangles { vec4 items[]; } treeTriangles;
#define AG_BVH_MOVERS
#define AG_BVH_SHARE(opaqueFrom, triangle) (opaqueFrom)
#include "bvh/trace.glsl"

const float kAll = 0.0, kUnmasked = 0.999;  // opacity of triangles that rays meet
const uint kNothing = 0, kMaskedAlone = 1, kOpaque = 2;

uint blockerAlong(vec3 start, vec3 direction, float reach) {
    bool masked = false;
    for (int i = 0; i < 2; ++i) {
        BvhRay ray = BvhRay(start, direction, reach, masked ? kUnmasked : kAll, true, 0, 0);
        if (!traceOccluders(ray)) break;
        masked = treeTriangles.items[ray.triangle * 3].w < 1.0;
        if (!masked) return kOpaque;
    }
    return masked ? kMaskedAlone : kNothing;
}

// Before the surface that a pixel sees, by so many m or widths of the pixel, whichever is more.
vec3 shadowRayStart(vec3 position, vec3 normal, ivec2 pixel, float depth, RayOffsets o) {
    float width = distance(position, worldFromPixel(camera.camera.worldFromClip, camera.camera.size, pixel + ivec2(1, 0), depth));
    return position + (normal + normalize(camera.camera.position - position)) * max(o.least, o.ofPixel * width);
}
#endif
