// Blocks of pixels that draw lights alike.
#ifndef AG_BLOCKS_GLSL
#define AG_BLOCKS_GLSL

#include "texel_rays/texel_rays_io.h"

uvec2 blockOrigin(uint block, uvec2 size) {
    uint along = (size.x + kDrawBlock - 1) / kDrawBlock;
    return uvec2(block % along, block / along) * kDrawBlock;
}
#endif
