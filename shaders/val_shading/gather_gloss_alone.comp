#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Gloss of pixels that reflect like none of the cells about them: all area lights.
#define AG_GLOSSY
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
layout(set = 0, binding = 8) uniform sampler2D albedoMap;
layout(set = 0, binding = 9) uniform sampler2D reflectanceMap;
#include "val_shading/area_light.glsl"
#include "val_shading/gloss.glsl"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push { uint firstVal, valCount, ismTileSize; } push;

void main() {
    if (gl_GlobalInvocationID.x >= alone.count) return;
    uint packed = alone.pixels[gl_GlobalInvocationID.x];
    ivec2 pixel = ivec2(packed & 0xffffu, packed >> 16);
    mat4 worldFromClip = camera.camera.worldFromClip;
    uvec2 size = camera.camera.size;
    float depth = texelFetch(depthMap, pixel, 0).x;
    vec4 normal = texelFetch(normalMap, pixel, 0);
    vec3 place = worldFromPixel(worldFromClip, size, pixel, depth);
    float width = distance(place, worldFromPixel(worldFromClip, size, pixel + ivec2(1, 0), depth));
    Specular specular = specularOf(normalize(camera.camera.position - place), normal.w, texelFetch(reflectanceMap, pixel, 0),
                                   texelFetch(albedoMap, pixel, 0).rgb);
    vec3 radiance = vec3(0.0);
    for (uint i = push.firstVal; i < push.valCount; ++i) {
        AreaLight l = loadLight(i);
        if (l.power.rgb == vec3(0.0)) continue;
        vec3 e = irradianceFrom(l, place, normal.xyz, width, push.ismTileSize);
        radiance += specularRadiance(specular, place, normal.xyz, l, e);
    }
    imageStore(result, pixel, vec4(min(radiance, vec3(kMostHalf)), 1.0));
}
