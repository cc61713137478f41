// A pixel's surface, of four that an invocation takes. Needs samplers `normalMap` and `depthMap` and buffer `camera`.
#ifndef AG_RECEIVER_GLSL
#define AG_RECEIVER_GLSL

#include "gbuffer/gbuffer.glsl"

const int kPixels = 4;

struct Receiver {
    vec3 position, normal;
    float roughness;
    float depth;
};

Receiver receiverAt(uvec2 at) {
    uvec2 size = camera.camera.size;
    ivec2 pixel = ivec2(min(at, size - 1));
    Receiver r;
    r.depth = texelFetch(depthMap, pixel, 0).x;
    r.position = worldFromPixel(camera.camera.worldFromClip, size, pixel, r.depth);
    vec4 normalAndRoughness = texelFetch(normalMap, pixel, 0);
    r.normal = normalAndRoughness.xyz;
    r.roughness = normalAndRoughness.w;
    return r;
}
#endif
