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

// The texel that a direction looks at.
uvec2 skyTexelAt(vec3 direction) {
    vec2 place = vec2(atan(direction.z, direction.x) / (2.0 * kPi) + 0.5, 0.5 - 0.5 * direction.y);
    return min(uvec2(clamp(place, vec2(0.0), vec2(1.0)) * float(kSkySide)), uvec2(kSkySide - 1));
}

// What lies that way, and how likely it is to be drawn.
SkyDraw skyAlong(vec3 direction) {
    uvec2 at = skyTexelAt(direction), inCell = at % kSkyCell;
    uint cell = at.y / kSkyCell * (kSkySide / kSkyCell) + at.x / kSkyCell, index = inCell.y * kSkyCell + inCell.x;
    float all = AG_SKY_UP_TO(kSkyCells - 1), before = cell > 0 ? AG_SKY_UP_TO(cell - 1) : 0.0;
    vec4 texel = fetchTexel(skyTexels, int(cell * kSkyCellTexels + index));
    float share = texel.w - (index > 0 ? fetchTexel(skyTexels, int(cell * kSkyCellTexels + index - 1)).w : 0.0);
    const float kTexelsPerSteradian = float(kSkySide * kSkySide) / (4.0 * kPi);
    float chance = all > 0.0 ? (AG_SKY_UP_TO(cell) - before) / all : 0.0;
    return SkyDraw(cell, direction, texel.rgb, chance * share * kTexelsPerSteradian);
}
#endif
