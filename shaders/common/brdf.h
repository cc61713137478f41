// The glTF 2.0 metallic-roughness surface (specification, appendix B) with KHR_materials_specular: a Lambert
// base under a GGX specular lobe. metallic 0 and specular 0 is exactly Lambert.
#ifndef AG_BRDF_H
#define AG_BRDF_H

#include "common/portable.h"

AG_BEGIN

AG_FUNCTION vec3 diffuseAlbedo(vec3 baseColor, float metallic) {
    return baseColor * (1.0f - metallic);
}

// Of a normal map's mean in tangent space, whose strength is scaled: 1 long of one normal, shorter of
// several.
AG_FUNCTION vec3 scaledBumps(vec3 mapped, float scale) {
    vec3 scaled = vec3(mapped.x * scale, mapped.y * scale, mapped.z);
    float squared = dot(scaled, scaled);
    return squared > 0.0f ? sqrt(dot(mapped, mapped) / squared) * scaled : vec3(0.0f, 0.0f, 1.0f);
}

// Mean of the bumps' cosines to a light, each 0 or more: those that turn away from it take nothing from the
// others. `mean`: of their normals; the shorter, the more they spread. `cosine`: of the smooth surface. The
// root is fitted to the normal maps of three scenes: its mean over them is within 1 % for cosines from 0.1
// on.
AG_FUNCTION float bumpCosine(vec3 mean, vec3 toLight, float cosine) {
    float along = dot(mean, toLight);
    float spread = max(1.0f - dot(mean, mean), 0.0f) * max(1.0f - cosine * cosine, 0.0f);
    return 0.5f * (along + sqrt(along * along + 0.2f * spread));
}

// Share of a smooth surface's irradiance that its bumps receive of light from everywhere above it: a bump
// sees less of that, not less of what it sees.
AG_FUNCTION float bumpShareOfHemisphere(vec3 mapped, float scale) {
    return clamp(0.5f + 0.5f * scaledBumps(mapped, scale).z, 0.0f, 1.0f);
}

// Reflectance head on; a dielectric's is that of refractive index 1.5.
AG_FUNCTION vec3 specularF0(vec3 baseColor, float metallic, float specular) {
    return mix(vec3(0.04f * specular), baseColor, metallic);
}

// And at grazing angles.
AG_FUNCTION float specularF90(float metallic, float specular) {
    return mix(min(specular, 1.0f), 1.0f, metallic);
}

AG_FUNCTION vec3 fresnelSchlick(vec3 f0, vec3 f90, float cosine) {
    float m = clamp(1.0f - cosine, 0.0f, 1.0f);
    return f0 + (f90 - f0) * (m * m * m * m * m);
}

// Mean of Fresnel's term over light from everywhere, weighted by its cosine: what the lobe keeps from what is
// under it. The polynomial is the mean of Schlick's (1 - v·h)^5 (within 0.0002, by quadrature). `cosine`: to
// the viewer.
AG_FUNCTION vec3 meanFresnel(vec3 f0, vec3 f90, float cosine) {
    float c = clamp(cosine, 0.0f, 1.0f);
    return f0 + (f90 - f0) * (0.02805f + c * (-0.07738f + c * (0.07501f - c * 0.02571f)));
}

// What a thin sheet lets through of the light behind it: past it where alpha (coverage) leaves it open,
// tinted where it transmits (KHR_materials_transmission), but for what it reflects.
AG_FUNCTION vec3 sheetTransmits(vec3 baseColor, float metallic, float coverage, float transmission,
                                vec3 reflected) {
    vec3 glass = transmission * (1.0f - metallic) * baseColor * (vec3(1.0f) - reflected);
    return vec3(1.0f) - coverage * (vec3(1.0f) - glass);
}

// Share of light from everywhere that a lobe reflects, of Fresnel's term at 0 and at 1: its means over all
// directions (within 0.003, by quadrature).
AG_FUNCTION vec2 lobeMeans(float roughness) {
    float r = roughness;
    float headOn = 0.95292f + r * (-0.06587f + r * (0.81978f + r * (-2.90110f + r * 1.57043f)));
    float grazing = max(0.04941f + r * (-0.01769f + r * (-0.13879f + r * 0.11117f)), 0.0f);
    return vec2(headOn, grazing);
}

// The same of the whole surface, lobe and base, for light that goes on from it as if all of it were diffuse.
AG_FUNCTION vec3 wholeReflectance(vec3 baseColor, float metallic, float roughness, float specular) {
    vec3 f0 = specularF0(baseColor, metallic, specular);
    vec2 means = lobeMeans(roughness);
    vec3 lobe = f0 * means.x + vec3(specularF90(metallic, specular) * means.y);
    return (vec3(1.0f) - f0) * diffuseAlbedo(baseColor, metallic) + lobe;
}

// Trowbridge-Reitz distribution of half vectors, alpha = roughness².
AG_FUNCTION float ggxDistribution(float nh, float alpha) {
    float a2 = alpha * alpha;
    float d = nh * nh * (a2 - 1.0f) + 1.0f;
    return nh > 0.0f ? a2 * kInvPi / max(d * d, 1e-20f) : 0.0f;
}

// Smith's masking of one direction, separable.
AG_FUNCTION float smithMasking(float cosine, float alpha) {
    float a2 = alpha * alpha;
    return 2.0f * cosine / max(cosine + sqrt(a2 + (1.0f - a2) * cosine * cosine), 1e-12f);
}

// A half vector as likely as the viewer v sees it, both about the normal z (Heitz 2018, Sampling the GGX
// Distribution of Visible Normals): the lobe then weighs Fresnel's term times smithMasking of the light.
AG_FUNCTION vec3 visibleHalfVector(vec3 v, float alpha, vec2 xi) {
    vec3 s = normalize(vec3(alpha * v.x, alpha * v.y, v.z));
    float across = s.x * s.x + s.y * s.y;
    vec3 t = across > 1e-12f ? vec3(-s.y, s.x, 0.0f) * inversesqrt(across) : vec3(1.0f, 0.0f, 0.0f);
    float r = sqrt(xi.x), phi = 2.0f * kPi * xi.y, x = r * cos(phi), half_ = 0.5f * (1.0f + s.z);
    float y = (1.0f - half_) * sqrt(max(1.0f - x * x, 0.0f)) + half_ * r * sin(phi);
    vec3 h = x * t + y * cross(s, t) + sqrt(max(1.0f - x * x - y * y, 0.0f)) * s;
    return normalize(vec3(alpha * h.x, alpha * h.y, max(h.z, 1e-6f)));
}

// Roughness below this is a mirror to a light that is a point: it reflects nothing one could sample.
const float kLeastAlpha = 1e-3f;

// Outgoing radiance per incident irradiance, 1/sr. n, v (to the viewer), l (to the light): unit.
AG_FUNCTION vec3 metallicRoughnessBrdf(vec3 n, vec3 v, vec3 l, vec3 baseColor, float metallic,
                                       float roughness, float specular) {
    float nv = dot(n, v);
    float nl = dot(n, l);
    if (nv <= 0.0f || nl <= 0.0f) return vec3(0.0f);
    vec3 h = normalize(v + l);
    float alpha = max(roughness * roughness, kLeastAlpha);
    vec3 f90 = vec3(specularF90(metallic, specular));
    vec3 f = fresnelSchlick(specularF0(baseColor, metallic, specular), f90, dot(v, h));
    float lobe = ggxDistribution(dot(n, h), alpha) * smithMasking(nv, alpha) * smithMasking(nl, alpha) /
                 (4.0f * nv * nl);
    return (vec3(1.0f) - f) * diffuseAlbedo(baseColor, metallic) * kInvPi + f * lobe;
}

// BRDF over that of a diffuse surface of the same reflectance. `whole`: wholeReflectance; a: the lobe's head
// on, mean of the channels, above 0. Where the lobe makes up the whole it has the colour of that, as a
// metal's; else it is white. n, v (to where light goes), l (to where it comes from): unit.
AG_FUNCTION vec3 shareOfDirection(vec4 whole, float roughness, vec3 n, vec3 v, vec3 l) {
    float nv = dot(n, v), nl = dot(n, l);
    if (nv <= 0.0f || nl <= 0.0f) return vec3(1.0f);
    vec3 reflectance = max(vec3(whole.x, whole.y, whole.z), vec3(1e-6f)), h = normalize(v + l);
    vec2 means = lobeMeans(roughness);
    float f90 = min(25.0f * whole.w, 1.0f), alpha = max(roughness * roughness, kLeastAlpha);
    float ofLobe =
        (whole.w * means.x + f90 * means.y) * 3.0f / (reflectance.x + reflectance.y + reflectance.z);
    vec3 asMetal = max(reflectance - vec3(f90 * means.y), vec3(0.0f)) / means.x;
    float metal = min(ofLobe * ofLobe * ofLobe * ofLobe, 1.0f);
    metal *= metal;
    vec3 f0 = mix(vec3(whole.w), asMetal, metal), f = fresnelSchlick(f0, vec3(f90), dot(v, h));
    vec3 under = max(reflectance - f0 * means.x - vec3(f90 * means.y), vec3(0.0f)) * (vec3(1.0f) - f) /
                 max(vec3(1.0f) - f0, vec3(1e-3f));
    float lobe = ggxDistribution(dot(n, h), alpha) * smithMasking(nv, alpha) * smithMasking(nl, alpha) /
                 (4.0f * nv * nl);
    return (under + f * (lobe * kPi)) / reflectance;
}

AG_END
#endif
