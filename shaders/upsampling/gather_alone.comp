#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Pixels of surfaces that no gathered pixel lies on, as a lit reveal that is one pixel wide: all area lights, as polygons.
layout(constant_id = 0) const uint kShape = 4;
layout(constant_id = 1) const int kVisibilityTaps = 0;
#include "common/listed_pixel.glsl"
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

void main() {
    if (gl_GlobalInvocationID.x >= alone.count) return;
    ivec2 pixel = listedPixel(alone.pixels[gl_GlobalInvocationID.x]);
    mat4 worldFromClip = camera.camera.worldFromClip;
    uvec2 size = camera.camera.size;
    float depth = texelFetch(depthMap, pixel, 0).x;
    vec3 normal = texelFetch(normalMap, pixel, 0).xyz, position = worldFromPixel(worldFromClip, size, pixel, depth);
    float width = distance(position, worldFromPixel(worldFromClip, size, pixel + ivec2(1, 0), depth));  // m
    vec3 e = vec3(0.0);
    for (uint i = push.firstVal; i < push.valCount; ++i) {
        AreaLight l = loadLight(i);
        if (l.power.rgb != vec3(0.0)) e += irradianceFrom(l, position, normal, width, push.ismTileSize);
    }
    imageStore(result, pixel, vec4(min(e, vec3(kMostHalf)), 0.0));
}
