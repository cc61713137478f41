// Irradiance straight from a sun, one pass each. Shadow by nine taps of its cascades, or by a ray.
#include "gbuffer/gbuffer.glsl"
#include "shadow_maps/shadow_maps_io.h"

layout(local_size_x = 16, local_size_y = 16) in;
layout(push_constant, scalar) uniform Push { Sun sun; } push;
layout(constant_id = 1) const bool kFirst = true;  // starts from zero instead of adding

layout(set = 0, binding = 0) uniform sampler2D normalMap;
layout(set = 0, binding = 1) uniform sampler2D depthMap;
layout(set = 0, binding = 2, scalar) uniform Camera { CameraConstants camera; } camera;
layout(set = 0, binding = 4, rgba16f) uniform image2D irradiance;
#include "direct_lighting/highlight.glsl"
#ifdef AG_SHADOW
layout(set = 0, binding = 5, scalar) uniform ShadowViews { ShadowView items[kMaxShadowViews]; } shadowViews;
layout(set = 0, binding = 6) uniform sampler2D shadowAtlas;
#include "direct_lighting/shadow_lookup.glsl"

float sunShare(vec3 position, vec3 normal, float viewDepth) {
    uint cascade = push.sun.firstView;
    for (uint i = 0; i + 1 < push.sun.viewCount; ++i)
        cascade += viewDepth > shadowViews.items[push.sun.firstView + i].farDistance ? 1 : 0;
    ShadowView view = shadowViews.items[cascade];
    return litShare(ShadowMap(view.clipFromWorld, view.origin, view.size), view.texelSize, position, normal, -push.sun.direction);
}
#endif
#ifdef AG_TRACED
#include "common/texels.glsl"
layout(set = 0, binding = 20) UVEC4_TEXELS(treeNodes);
layout(set = 0, binding = 21) UVEC4_TEXELS(moverNodes);
layout(set = 0, binding = 22) UVEC4_TEXELS(treePlaces);
layout(set = 0, binding = 23, scalar) readonly buffer TreeTriangles { vec4 items[]; } treeTriangles;
#define AG_BVH_MOVERS
#define AG_BVH_SHARE(opaqueFrom, triangle) (opaqueFrom)
#include "bvh/trace.glsl"

const float kAll = 0.0, kUnmasked = 0.999;  // opacity of triangles that rays meet

// Trees know the mean opacity of masked triangles alone. Where nothing else is in the way, the shadow maps are asked.
float tracedShare(vec3 position, vec3 normal, float pixelWidth, float viewDepth) {
    float offset = max(push.sun.rayOffset, push.sun.pixelOffset * pixelWidth);
    vec3 start = position + (normal + normalize(camera.camera.position - position)) * offset;
    bool masked = false;
    for (int i = 0; i < 2; ++i) {
        BvhRay ray = BvhRay(start, -push.sun.direction, push.sun.rayReach, masked ? kUnmasked : kAll, true, 0, 0);
        if (!traceOccluders(ray)) break;
        masked = treeTriangles.items[ray.triangle * 3].w < 1.0;
        if (!masked) return 0.0;
    }
    return masked ? sunShare(position, normal, viewDepth) : 1.0;
}
#endif

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    uvec2 size = camera.camera.size;
    if (any(greaterThanEqual(pixel, ivec2(size)))) return;
    float depth = texelFetch(depthMap, pixel, 0).x;
    vec3 position = worldFromPixel(camera.camera.worldFromClip, size, pixel, depth);
    vec4 normalAndRoughness = texelFetch(normalMap, pixel, 0);
    vec3 normal = normalAndRoughness.xyz;
    vec3 e = push.sun.irradiance * max(dot(normal, -push.sun.direction), 0.0);
#if defined(AG_TRACED)
    bool faces = depth > 0.0 && e != vec3(0.0);
    float pixelWidth = distance(position, worldFromPixel(camera.camera.worldFromClip, size, pixel + ivec2(1, 0), depth));
    e *= faces ? tracedShare(position, normal, pixelWidth, camera.camera.near / max(depth, 1e-9)) : 0.0;
#elif defined(AG_SHADOW)
    e *= sunShare(position, normal, camera.camera.near / max(depth, 1e-9));
#endif
    if (depth <= 0.0) e = vec3(0.0);
    if (kGlossy) {
        Lobe lobe = lobeAt(pixel, position, normalAndRoughness.w);
        addHighlight(pixel, highlightOf(lobe, normal, -push.sun.direction, e), kFirst);
    }
    if (!kFirst) e += imageLoad(irradiance, pixel).rgb;
    imageStore(irradiance, pixel, vec4(min(e, vec3(kMostHalf)), 1.0));
}
