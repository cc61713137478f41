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

// Khronos PBR Neutral 2024: colours below 0.8 come out as they are but for the 4 % that dielectrics reflect
// of white; brighter ones are compressed and go to white.
AG_FUNCTION vec3 tonemapNeutral(vec3 c) {
    const float kReflected = 0.04f, kBegin = 0.8f - 0.04f, kDesaturation = 0.15f;
    float least = min(c.x, min(c.y, c.z));
    c -= vec3(least < 2.0f * kReflected ? least - least * least / (4.0f * kReflected) : kReflected);
    float peak = max(c.x, max(c.y, c.z));
    if (peak < kBegin) return c;
    float room = 1.0f - kBegin, compressed = 1.0f - room * room / (peak + room - kBegin);
    float white = 1.0f - 1.0f / (kDesaturation * (peak - compressed) + 1.0f);
    return mix(c * (compressed / peak), vec3(compressed), white);
}

// AgX (Sobotka 2022) as Wrensch 2023 fits it: through primaries drawn together, the logarithm of 16.5 stops
// and a polynomial for its sigmoid, so that bright colours pale as film does.
AG_FUNCTION vec3 tonemapAgx(vec3 c) {
    const float kLeastStops = -12.47393f, kMostStops = 4.026069f;
    vec3 drawn = vec3(dot(c, vec3(0.842479062f, 0.0784336f, 0.0792237451f)),
                      dot(c, vec3(0.0423282422f, 0.878468636f, 0.0791661275f)),
                      dot(c, vec3(0.0423756549f, 0.0784336f, 0.879142974f)));
    drawn = max(drawn, vec3(1e-10f));
    vec3 x =
        (vec3(log2(drawn.x), log2(drawn.y), log2(drawn.z)) - vec3(kLeastStops)) / (kMostStops - kLeastStops);
    x = clamp(x, vec3(0.0f), vec3(1.0f));
    vec3 x2 = x * x, x4 = x2 * x2;
    vec3 s = 15.5f * x4 * x2 - 40.14f * x4 * x + 31.96f * x4 - 6.868f * x2 * x + 0.4298f * x2 + 0.1191f * x -
             vec3(0.00232f);
    vec3 apart = vec3(dot(s, vec3(1.19687900f, -0.0980208811f, -0.0990297441f)),
                      dot(s, vec3(-0.0528968518f, 1.15190313f, -0.0989611768f)),
                      dot(s, vec3(-0.0529716355f, -0.0980434501f, 1.15107367f)));
    apart = clamp(apart, vec3(0.0f), vec3(1.0f));
    return vec3(pow(apart.x, 2.2f), pow(apart.y, 2.2f), pow(apart.z, 2.2f));
}

// mode: 0 none, 1 Reinhard, 2 ACES-like, 3 neutral, 4 AgX. Returns sRGB-encoded values in [0, 1].
AG_FUNCTION vec3 applyTonemap(vec3 radiance, float exposure, uint mode) {
    vec3 c = max(radiance * exposure, vec3(0.0f));
    c = min(c, vec3(1e6f));
    if (mode == 1u) c = tonemapReinhard(c);
    if (mode == 2u) c = tonemapAcesLike(c);
    if (mode == 3u) c = tonemapNeutral(c);
    if (mode == 4u) c = tonemapAgx(c);
    return srgbFromLinear(clamp(c, vec3(0.0f), vec3(1.0f)));
}

AG_END
#endif
