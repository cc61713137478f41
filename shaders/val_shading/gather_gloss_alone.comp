#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Gloss of pixels that reflect like none of the cells about them: all area lights, of one shape and with as many taps.
#define AG_GLOSSY
#include "upsampling/alone.glsl"
#include "val_shading/gloss.glsl"
layout(set = 0, binding = 8) uniform sampler2D albedoMap;
layout(set = 0, binding = 9) uniform sampler2D reflectanceMap;

void main() {
    if (gl_GlobalInvocationID.x >= alone.count) return;
    AlonePixel p = alonePixel(gl_GlobalInvocationID.x);
    Specular specular = specularOf(normalize(camera.camera.position - p.position), p.normal.w,
                                   texelFetch(reflectanceMap, p.pixel, 0), texelFetch(albedoMap, p.pixel, 0).rgb);
    vec3 radiance = vec3(0.0);
    for (uint i = push.firstVal; i < push.valCount; ++i) {
        AreaLight l = loadLight(i);
        if (l.power.rgb == vec3(0.0)) continue;
        vec3 e = irradianceFrom(l, p.position, p.normal.xyz, p.width, push.ismTileSize);
        radiance += specularRadiance(specular, p.position, p.normal.xyz, l, e);
    }
    imageStore(result, p.pixel, vec4(min(radiance, vec3(kMostHalf)), 1.0));
}
