// The sky as texels of equal solid angle: columns go round, rows are even in the direction's y. Squares of
// texels are cells, which directions are drawn by.
#ifndef AG_SKY_IO_H
#define AG_SKY_IO_H

#include "common/portable.h"

AG_BEGIN

const uint kSkySide = 128;   // texels round, and from top to bottom
const uint kSkyCell = 8;     // texels along a cell's side
const uint kSkyCells = 256;  // of all
const uint kSkyCellTexels = 64;
const uint kSkyBlock = 8;  // pixels along the side of a block whose pixels draw directions alike

struct SkyTexel {   // cell by cell
    vec3 radiance;  // W/(m² sr), the mean
    float upTo;     // how likely a draw in its cell is this texel or one before, in [0, 1]
};

struct SkyChoosePush {
    uint known;  // 0: there is no frame before
};

struct SkyCastPush {
    uint step;          // another in each frame with new rays
    vec3 shift;         // of the noise
    float offset;       // m: rays leave surfaces so far before them,
    float pixelOffset;  // and pixels
    float reach;        // m: beyond it nothing stands
    uint known;         // 0: there is no frame before
    float keep;         // of what earlier frames learned
};

struct SkyPointsPush {
    uint count;
    uint rays;  // a point
    uint step;
    float offset;
    float reach;
    uint valid;        // 0: there is no frame before
    float mostLength;  // rays that a mean stands for
};

// Of the unit square: x round, y from top to bottom.
AG_FUNCTION vec3 skyDirectionAt(vec2 place) {
    float y = 1.0f - 2.0f * place.y, s = sqrt(max(1.0f - y * y, 0.0f)), phi = (place.x - 0.5f) * 2.0f * kPi;
    return vec3(s * cos(phi), y, s * sin(phi));
}

// The middle of a texel's square, or with `inside` any place of it.
AG_FUNCTION vec2 skyPlaceOf(uint cell, uint texel, vec2 inside) {
    const uint kAlong = kSkySide / kSkyCell;
    uvec2 at = uvec2(cell % kAlong, cell / kAlong) * kSkyCell + uvec2(texel % kSkyCell, texel / kSkyCell);
    return (vec2(at) + inside) / float(kSkySide);
}

AG_END

#endif
