// Blocks of pixels that draw lights alike, and which of them cast rays in a frame. Before: `youngest`, of each block's means
// the fewest frames that one stands for.
#ifndef AG_BLOCKS_GLSL
#define AG_BLOCKS_GLSL

#include "texel_rays/texel_rays_io.h"

const float kYoung = 16.0;  // frames a mean stands for: below it a block casts rays in each frame,
const uint kSeldom = 4;     // from then on in every so many

uvec2 blockOrigin(uint block, uvec2 size) {
    uint along = (size.x + kDrawBlock - 1) / kDrawBlock;
    return uvec2(block % along, block / along) * kDrawBlock;
}

// `step`: of the frame. `known` 0: there is none before.
bool castsRays(uint block, uint step, uint known) {
    return known == 0 || youngest.items[block] < kYoung || (block * 5u + step) % kSeldom == 0;
}
#endif
