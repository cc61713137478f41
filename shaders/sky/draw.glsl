// Directions to the sky drawn by its brightness. Before: VEC4_TEXELS skyTexels (SkyTexel); a macro AG_SKY_UP_TO(cell), how
// likely a cell or one before it is.
#ifndef AG_SKY_DRAW_GLSL
#define AG_SKY_DRAW_GLSL

#include "sky/sky_io.h"

struct SkyDraw {
    uint cell;
    vec3 direction, radiance;
    float density;  // 1/sr; 0: none was drawn
};

// The first cell whose sum is beyond `x`.
uint drawnCell(float x) {
    uint low = 0, high = kSkyCells - 1;
    while (low < high) {
        uint middle = (low + high) / 2;
        bool after = AG_SKY_UP_TO(middle) <= x;
        low = after ? middle + 1 : low;
        high = after ? high : middle;
    }
    return low;
}

// `xi`: in [0, 1)³.
SkyDraw drawSky(vec3 xi) {
    float all = AG_SKY_UP_TO(kSkyCells - 1), x = xi.x * all;
    uint cell = drawnCell(x);
    float before = cell > 0 ? AG_SKY_UP_TO(cell - 1) : 0.0, chance = AG_SKY_UP_TO(cell) - before;
    float within = clamp((x - before) / max(chance, 1e-20), 0.0, 0.999999);
    uint low = 0, high = kSkyCellTexels - 1, first = cell * kSkyCellTexels;
    while (low < high) {
        uint middle = (low + high) / 2;
        bool after = fetchTexel(skyTexels, int(first + middle)).w <= within;
        low = after ? middle + 1 : low;
        high = after ? high : middle;
    }
    vec4 texel = fetchTexel(skyTexels, int(first + low));
    float share = texel.w - (low > 0 ? fetchTexel(skyTexels, int(first + low - 1)).w : 0.0);
    const float kTexelsPerSteradian = float(kSkySide * kSkySide) / (4.0 * kPi);
    vec3 direction = skyDirectionAt(skyPlaceOf(cell, low, xi.yz));
    return SkyDraw(cell, direction, texel.rgb, all > 0.0 ? chance / all * share * kTexelsPerSteradian : 0.0);
}
#endif
