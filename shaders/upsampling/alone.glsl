// Listed pixels that meet all area lights by themselves: where each is, and which lights there are.
#ifndef AG_UPSAMPLING_ALONE
#define AG_UPSAMPLING_ALONE
layout(constant_id = 0) const uint kShape = 4;
layout(constant_id = 1) const int kVisibilityTaps = 0;
#include "common/texels.glsl"
#include "gbuffer/gbuffer.glsl"
layout(set = 0, binding = 0) uniform sampler2D normalMap;
layout(set = 0, binding = 1) uniform sampler2D depthMap;
layout(set = 0, binding = 2, scalar) uniform Camera { CameraConstants camera; } camera;
layout(set = 0, binding = 3) VEC4_TEXELS(vals);
layout(set = 0, binding = 4) VEC4_TEXELS(shapes);
layout(set = 0, binding = 5) VEC4_TEXELS(isms);
layout(set = 0, binding = 6, scalar) readonly buffer Alone { uint count; uint pixels[]; } alone;
layout(set = 0, binding = 7, rgba16f) uniform writeonly image2D result;
#include "val_shading/area_light.glsl"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push { uint firstVal, valCount, ismTileSize; } push;

struct AlonePixel {
    ivec2 pixel;
    vec3 position;
    vec4 normal;  // and roughness
    float width;  // m
};

AlonePixel alonePixel(uint index) {
    uint packed = alone.pixels[index];
    AlonePixel p;
    p.pixel = ivec2(packed & 0xffffu, packed >> 16);
    mat4 worldFromClip = camera.camera.worldFromClip;
    uvec2 size = camera.camera.size;
    float depth = texelFetch(depthMap, p.pixel, 0).x;
    p.normal = texelFetch(normalMap, p.pixel, 0);
    p.position = worldFromPixel(worldFromClip, size, p.pixel, depth);
    p.width = distance(p.position, worldFromPixel(worldFromClip, size, p.pixel + ivec2(1, 0), depth));
    return p;
}
#endif
