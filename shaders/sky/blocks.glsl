// Blocks of pixels that draw directions to the sky alike.
#ifndef AG_SKY_BLOCKS_GLSL
#define AG_SKY_BLOCKS_GLSL

#include "sky/sky_io.h"

uvec2 skyBlockOrigin(uint block, uvec2 size) {
    uint along = (size.x + kSkyBlock - 1) / kSkyBlock;
    return uvec2(block % along, block / along) * kSkyBlock;
}
#endif
