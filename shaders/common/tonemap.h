// From linear radiance to display values.
#ifndef AG_TONEMAP_H
#define AG_TONEMAP_H

#include "common/portable.h"

AG_BEGIN

AG_FUNCTION float srgbFromLinear1(float x) {
    return x <= 0.0031308f ? 12.92f * x : 1.055f * pow(x, 1.0f / 2.4f) - 0.055f;
}
AG_FUNCTION float linearFromSrgb1(float x) {
    return x <= 0.04045f ? x / 12.92f : pow((x + 0.055f) / 1.055f, 2.4f);
}
AG_FUNCTION vec3 srgbFromLinear(vec3 c) {
    return vec3(srgbFromLinear1(c.x), srgbFromLinear1(c.y), srgbFromLinear1(c.z));
}
AG_FUNCTION vec3 linearFromSrgb(vec3 c) {
    return vec3(linearFromSrgb1(c.x), linearFromSrgb1(c.y), linearFromSrgb1(c.z));
}

// Reinhard 2002, per channel.
AG_FUNCTION vec3 tonemapReinhard(vec3 c) {
    return c / (vec3(1.0f) + c);
}

// A rational curve near the ACES reference transform (Narkowicz 2015's coefficients).
AG_FUNCTION vec3 tonemapAcesLike(vec3 c) {
    vec3 top = c * (c * 2.51f + vec3(0.03f));
    vec3 bottom = c * (c * 2.43f + vec3(0.59f)) + vec3(0.14f);
    return clamp(top / bottom, vec3(0.0f), vec3(1.0f));
}

// mode: 0 none, 1 Reinhard, 2 ACES-like. Returns sRGB-encoded values in [0, 1].
AG_FUNCTION vec3 applyTonemap(vec3 radiance, float exposure, uint mode) {
    vec3 c = max(radiance * exposure, vec3(0.0f));
    c = min(c, vec3(1e6f));
    if (mode == 1u) c = tonemapReinhard(c);
    if (mode == 2u) c = tonemapAcesLike(c);
    return srgbFromLinear(clamp(c, vec3(0.0f), vec3(1.0f)));
}

AG_END
#endif
