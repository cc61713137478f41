// A material's specular lobe, and rays drawn by it.
#ifndef AG_SPECULAR_LOBE_GLSL
#define AG_SPECULAR_LOBE_GLSL

#include "common/brdf.h"
#include "common/sampling.h"

struct SpecularLobe {
    vec3 normal, toViewer;
    vec4 reflectance;  // head on; at grazing angles
    float alpha;
};

SpecularLobe specularLobe(vec4 normalAndRoughness, vec3 toViewer, vec4 reflectance) {
    float roughness = normalAndRoughness.w;
    return SpecularLobe(normalize(normalAndRoughness.xyz), toViewer, reflectance, max(roughness * roughness, kLeastAlpha));
}

struct LobeRay {
    vec3 direction;
    vec3 weight;  // of the radiance that comes along it, in the mean over all draws
};

// By half vectors that the viewer sees (Heitz 2018). The ray's weight is 0 where it would leave below the surface, and all are
// where the normal turns from the viewer.
LobeRay drawLobeRay(SpecularLobe c, vec2 xi) {
    vec3 t, b;
    orthonormalBasis(c.normal, t, b);
    vec3 v = vec3(dot(c.toViewer, t), dot(c.toViewer, b), dot(c.toViewer, c.normal));
    if (v.z <= 0.0) return LobeRay(c.normal, vec3(0.0));
    vec3 about = visibleHalfVector(v, c.alpha, xi), h = t * about.x + b * about.y + c.normal * about.z;
    vec3 direction = reflect(-c.toViewer, h);
    float cosine = dot(c.normal, direction);
    if (cosine <= 0.0) return LobeRay(direction, vec3(0.0));
    return LobeRay(direction, fresnelSchlick(c.reflectance.rgb, vec3(c.reflectance.w), dot(c.toViewer, h)) * smithMasking(cosine, c.alpha));
}

// How likely such a draw is to take a direction, 1/sr.
float densityOfLobeRay(SpecularLobe c, vec3 toLight) {
    float nv = dot(c.normal, c.toViewer);
    vec3 h = normalize(c.toViewer + toLight);
    return nv > 0.0 ? ggxDistribution(dot(c.normal, h), c.alpha) * smithMasking(nv, c.alpha) / (4.0 * nv) : 0.0;
}

// The lobe alone, 1/sr.
vec3 lobeBrdf(SpecularLobe c, vec3 toLight) {
    float nv = dot(c.normal, c.toViewer), nl = dot(c.normal, toLight);
    if (nv <= 0.0 || nl <= 0.0) return vec3(0.0);
    vec3 h = normalize(c.toViewer + toLight), f = fresnelSchlick(c.reflectance.rgb, vec3(c.reflectance.w), dot(c.toViewer, h));
    return f * (ggxDistribution(dot(c.normal, h), c.alpha) * smithMasking(nv, c.alpha) * smithMasking(nl, c.alpha) / (4.0 * nv * nl));
}
#endif
