// Shadows by a ray, which holes of masked triangles let pass. Needs buffer `camera`.
#ifndef AG_TRACED_SHADOW_GLSL
#define AG_TRACED_SHADOW_GLSL

#include "common/texels.glsl"
#include "scene/alpha.glsl"

layout(set = 0, binding = 20) UVEC4_TEXELS(treeNodes);
layout(set = 0, binding = 21) UVEC4_TEXELS(moverNodes);
layout(set = 0, binding = 22) UVEC4_TEXELS(treePlaces);
layout(set = 0, binding = 23, scalar) readonly buffer TreeTriangles { vec4 items[]; } treeTriangles;
layout(set = 0, binding = 24, scalar) readonly buffer TreeMasks { vec4 items[]; } treeMasks;  // BvhMask
layout(set = 0, binding = 25) uniform sampler2DArray srgb256;
layout(set = 0, binding = 26) uniform sampler2DArray srgb512;
layout(set = 0, binding = 27) uniform sampler2DArray srgb1024;
layout(set = 0, binding = 28) uniform sampler2DArray srgb2048;
layout(constant_id = 20) const bool kMasks = false;

bool isHole(int triangle, float u, float v) {
    vec4 uv01 = treeMasks.items[triangle * 2], rest = treeMasks.items[triangle * 2 + 1];
    vec2 uv = uv01.xy * (1.0 - u - v) + uv01.zw * u + rest.xy * v;
    int code = int(rest.z), layer = code >> 3;
    float alpha = 1.0;
    switch (code & 7) {
    case 1: alpha = finestAlpha(srgb256, uv, layer); break;
    case 2: alpha = finestAlpha(srgb512, uv, layer); break;
    case 3: alpha = finestAlpha(srgb1024, uv, layer); break;
    case 4: alpha = finestAlpha(srgb2048, uv, layer); break;
    }
    return alpha < rest.w;
}

#define AG_BVH_MOVERS
#define AG_BVH_STOPS(triangle, opacity, u, v, opaqueFrom) (!kMasks || (opacity) >= 1.0 || !isHole(triangle, u, v))
#include "bvh/trace.glsl"

bool isBlocked(vec3 start, vec3 direction, float reach) {
    BvhRay ray = BvhRay(start, direction, reach, 0.0, true, 0, 0);
    return traceOccluders(ray);
}

// Before the surface that a pixel sees, by so many m or widths of the pixel, whichever is more.
vec3 shadowRayStart(vec3 position, vec3 normal, ivec2 pixel, float depth, RayOffsets o) {
    float width = distance(position, worldFromPixel(camera.camera.worldFromClip, camera.camera.size, pixel + ivec2(1, 0), depth));
    return position + (normal + normalize(camera.camera.position - position)) * max(o.least, o.ofPixel * width);
}
#endif
