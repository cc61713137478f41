// What a material's specular lobe adds to the Lambert part of light from one direction: highlights of suns and punctual
// lights. Needs buffer `camera`.
#ifndef AG_HIGHLIGHT_GLSL
#define AG_HIGHLIGHT_GLSL

#include "common/brdf.h"

layout(constant_id = 3) const bool kGlossy = false;
layout(set = 0, binding = 10) uniform sampler2D albedoMap;
layout(set = 0, binding = 11) uniform sampler2D reflectanceMap;  // head on; at grazing angles
layout(set = 0, binding = 12, rgba16f) uniform image2D highlights;

struct Lobe {
    vec3 toViewer, f0, lambert;
    float f90, alpha;
};

// f90 0: there is none.
Lobe lobeAt(ivec2 pixel, vec3 position, float roughness) {
    vec4 reflectance = kGlossy ? texelFetch(reflectanceMap, pixel, 0) : vec4(0.0);
    vec3 albedo = kGlossy ? texelFetch(albedoMap, pixel, 0).rgb : vec3(0.0);
    return Lobe(normalize(camera.camera.position - position), reflectance.rgb, albedo * kInvPi, reflectance.w,
                max(roughness * roughness, kLeastAlpha));
}

// Radiance toward the viewer, of the irradiance `e` that comes from `toLight`; less than nothing where the lobe keeps light
// from what is under it.
vec3 highlightOf(Lobe c, vec3 n, vec3 toLight, vec3 e) {
    n = normalize(n);  // half floats are up to 0.0005 off, which is as much as narrow lobes
    float nv = dot(n, c.toViewer), nl = dot(n, toLight);
    if (c.f90 <= 0.0 || nv <= 0.0 || nl <= 0.0) return vec3(0.0);
    vec3 h = normalize(c.toViewer + toLight), f = fresnelSchlick(c.f0, vec3(c.f90), dot(c.toViewer, h));
    float lobe = ggxDistribution(dot(n, h), c.alpha) * smithMasking(nv, c.alpha) * smithMasking(nl, c.alpha) / (4.0 * nv * nl);
    return e * f * (lobe - c.lambert);
}

void addHighlight(ivec2 pixel, vec3 radiance, bool first) {
    if (!kGlossy) return;
    if (!first) radiance += imageLoad(highlights, pixel).rgb;
    imageStore(highlights, pixel, vec4(clamp(radiance, vec3(-kMostHalf), vec3(kMostHalf)), 1.0));
}
#endif
