// Layout of the importance pyramid: per face, level 0 (blocks in Morton order) first, then each coarser level; node j
// of a level has children 4j..4j+3 on the finer one.
#ifndef AG_PYRAMID_GLSL
#define AG_PYRAMID_GLSL

#include "importance/importance_io.h"

uint spreadBits(uint x) {
    x &= 0xffffu;
    x = (x | (x << 8)) & 0x00ff00ffu;
    x = (x | (x << 4)) & 0x0f0f0f0fu;
    x = (x | (x << 2)) & 0x33333333u;
    x = (x | (x << 1)) & 0x55555555u;
    return x;
}

uint compactBits(uint x) {
    x &= 0x55555555u;
    x = (x | (x >> 1)) & 0x33333333u;
    x = (x | (x >> 2)) & 0x0f0f0f0fu;
    x = (x | (x >> 4)) & 0x00ff00ffu;
    x = (x | (x >> 8)) & 0x0000ffffu;
    return x;
}

uint mortonFromCell(uvec2 cell) { return spreadBits(cell.x) | (spreadBits(cell.y) << 1); }
uvec2 cellFromMorton(uint code) { return uvec2(compactBits(code), compactBits(code >> 1)); }

// Levels above level 0 of a face of `size` texels (a power of two).
uint pyramidTopLevel(uint size) { return uint(findMSB(blocksAlong(size))); }

// First node of a level: the finer levels' 4^top + ... + 4^(top-level+1) nodes lie before it.
uint pyramidLevelOffset(uint top, uint level) {
    uint fine = 1u << (2u * (top + 1u));
    uint coarse = 1u << (2u * (top + 1u - level));
    return (fine - coarse) / 3u;
}
#endif
