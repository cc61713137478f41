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
#include "direct_lighting/traced_shadow.glsl"
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
    vec3 start = shadowRayStart(position, normal, pixel, depth, push.sun.offsets);
    e *= faces && !isBlocked(start, -push.sun.direction, push.sun.rayReach) ? 1.0 : 0.0;
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
