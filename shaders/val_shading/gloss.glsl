// What the specular lobe of a material adds to the Lambert part where area lights shine on it: a light is a bell about
// its centre's direction, as wide as its rectangle is seen in the plane of incidence and across it. The bell widens the
// lobe of half vectors, so that no light makes a spike and lights side by side make one surface (after virtual
// spherical Gaussian lights, Tokuyoshi 2015). Half vectors turn by half as much as directions, and across the plane by
// 1 / v·h times that.
#ifndef AG_GLOSS_GLSL
#define AG_GLOSS_GLSL

#include "common/brdf.h"
#include "val_shading/lobe.glsl"

// Squared width of a lobe over the squared angle of a light whose border it is half as high at as in the middle, so that
// lights side by side leave no grooves: half vectors turn by half a light's half side h = sqrt(3) angles, and the lobe
// is half as high at sqrt(sqrt(2) - 1) of its width.
const float kBell = 1.81;

struct Specular {
    vec3 toViewer;
    float alpha2;
    vec3 f0;
    float f90;
    vec3 lambert;  // BRDF of what is under it
};

// reflectance: head on, and at grazing angles.
Specular specularOf(vec3 toViewer, float roughness, vec4 reflectance, vec3 albedo) {
    float alpha = lobeWidth(roughness);
    return Specular(toViewer, alpha * alpha, reflectance.rgb, reflectance.w, albedo * kInvPi);
}

// Squared angle the light is wide along a unit vector across its direction.
float angularVariance(AreaLight l, vec3 along, float inverseDistance2) {
    float u = dot(l.halfU, along), v = dot(l.halfV, along);
    return (u * u + v * v) * inverseDistance2 / 3.0;
}

// 1 / (n·x + sqrt(...)) of Smith's masking, which is what is left of it in the BRDF.
float maskingOver(float cosine, float alpha2) { return 1.0 / (cosine + sqrt(alpha2 + (1.0 - alpha2) * cosine * cosine)); }

// Radiance toward the viewer, from the irradiance e that the light sends; less than nothing where the specular lobe keeps light
// from what is under it.
vec3 specularRadiance(Specular c, vec3 x, vec3 n, AreaLight l, vec3 e) {
    vec3 d = l.place.xyz - x;
    float inverse2 = 1.0 / max(dot(d, d), 1e-12);
    vec3 toLight = d * sqrt(inverse2), h = normalize(c.toViewer + toLight);
    vec3 across = normalize(cross(c.toViewer, toLight) + 1e-6 * n), inPlane = cross(across, h);
    float wideAcross = angularVariance(l, across, inverse2), wideInPlane = angularVariance(l, cross(across, toLight), inverse2);
    float vh = max(dot(c.toViewer, h), 0.1);
    // The lobe's two squared widths.
    float a2 = min(c.alpha2 + kBell * wideInPlane, 1.0), b2 = min(c.alpha2 + kBell * wideAcross / (vh * vh), 1.0);
    float na = dot(n, inPlane), nb = dot(n, across), nh = dot(n, h);
    float bell = na * na / a2 + nb * nb / b2 + nh * nh, nv = dot(n, c.toViewer);
    // Where a normal map's normal turns from the viewer, no lobe reaches it.
    float lobe = nh > 0.0 && nv > 0.0 ? kInvPi * inversesqrt(a2 * b2) / (bell * bell) : 0.0;
    float nl = max(dot(n, toLight), 0.5 * sqrt(wideInPlane));
    lobe *= maskingOver(max(nv, 0.0), c.alpha2) * maskingOver(nl, c.alpha2);
    return e * fresnelSchlick(c.f0, vec3(c.f90), vh) * (lobe - c.lambert);
}
#endif
