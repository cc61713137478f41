#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// What narrow lobes reflect of what is on screen: rays drawn by the lobe (Heitz 2018) walk over the picture until they pass
// behind a surface, which is met if it faces them and they are not far behind it (after McGuire and Mara 2014, with
// planes of the G-buffer's normals where they have a thickness in depth).
#include "common/listed_pixel.glsl"
#include "common/specular_lobe.glsl"
#include "common/texels.glsl"
#include "gbuffer/gbuffer.glsl"
#include "reflections/reflections_io.h"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push { ReflectionsMarchPush p; } push;
layout(set = 0, binding = 0) uniform sampler2D normalMap;
layout(set = 0, binding = 1) uniform sampler2D depthMap;
layout(set = 0, binding = 2) uniform sampler2D reflectanceMap;
layout(set = 0, binding = 3) uniform sampler2D radianceMap;
layout(set = 0, binding = 4, scalar) uniform Camera { CameraConstants camera; } camera;
layout(set = 0, binding = 5) UINT_TEXELS(noise);  // two 16-bit shares each
layout(set = 0, binding = 6, scalar) readonly buffer Smooth { uint count; uint pixels[]; } listed;
layout(set = 0, binding = 7, rgba16f) uniform writeonly image2D found;  // W/(m² sr); of the lobe, what is known

#include "reflections/screen_ray.glsl"

SpecularLobe lobeAt(ivec2 pixel, vec3 place) {
    return specularLobe(texelFetch(normalMap, pixel, 0), normalize(camera.camera.position - place), texelFetch(reflectanceMap, pixel, 0));
}

vec2 noiseAt(ivec2 pixel) {
    return unpackUnorm2x16(fetchTexel(noise, (pixel.y & 63) * 64 + (pixel.x & 63)).x);
}

// Of one ray: what it adds, and its part of the lobe, known and in all.
struct Sent {
    vec3 radiance;
    float known, all;
};

Sent sendRay(SpecularLobe c, vec3 place, vec2 xi, float start) {
    LobeRay r = drawLobeRay(c, xi);
    float all = luminance(r.weight);
    if (all <= 0.0) return Sent(vec3(0.0), 0.0, dot(c.normal, c.toViewer) > 0.0 ? 0.0 : 1.0);
    vec4 met = meetOnScreen(place, r.direction, start);
    return Sent(r.weight * met.rgb * met.w, all * met.w, all);
}

void main() {
    if (gl_GlobalInvocationID.x >= listed.count) return;
    ivec2 pixel = listedPixel(listed.pixels[gl_GlobalInvocationID.x]);
    vec3 place = worldFromPixel(camera.camera.worldFromClip, camera.camera.size, pixel, texelFetch(depthMap, pixel, 0).x);
    SpecularLobe lobe = lobeAt(pixel, place);
    vec2 shift = noiseAt(pixel);
    Sent sum = Sent(vec3(0.0), 0.0, 0.0);
    for (uint i = 0; i < push.p.rays; ++i) {
        Sent one = sendRay(lobe, place, fract(hammersley(i, push.p.rays) + shift), fract(shift.x + shift.y));
        sum.radiance += one.radiance;
        sum.known += one.known;
        sum.all += one.all;
    }
    vec3 radiance = min(sum.radiance / float(push.p.rays), vec3(kMostHalf));
    imageStore(found, pixel, vec4(radiance, sum.all > 0.0 ? sum.known / sum.all : 0.0));
}
