// Pixels by tiles: where an invocation's 2 x 2 pixels lie, which part of the lights they take, and the tile's lists.
#ifndef AG_SCREEN_TILES_GLSL
#define AG_SCREEN_TILES_GLSL

#include "gbuffer/gbuffer.glsl"
#include "val_shading/light_lists.glsl"

const int kPixels = 4;

// A tile's invocations, part after part. A part is every interleave-th pixel of each row and column.
struct TileBlock {
    uint tile, part;
    uvec2 origin;   // of the tile
    uvec2 inPart;   // of the first pixel among its part's
    uint interleave;
    bool spare;  // beyond the last tile's, which fill up a workgroup: does what another does
};

uint blocksOfTile(uint tileSize) { return tileSize * tileSize / 4; }

TileBlock tileBlock(uint invocation, uint tileSize, uvec2 tiles, uint interleave) {
    uint perTile = blocksOfTile(tileSize), side = tileSize / interleave / 2, perPart = side * side;
    TileBlock b;
    b.spare = invocation >= perTile * tiles.x * tiles.y;
    b.tile = min(invocation / perTile, tiles.x * tiles.y - 1);
    b.part = invocation % perTile / perPart;
    uint block = invocation % perPart;
    b.origin = uvec2(b.tile % tiles.x, b.tile / tiles.x) * tileSize;
    b.inPart = uvec2(block % side, block / side) * 2;
    b.interleave = interleave;
    return b;
}

ivec2 pixelOf(TileBlock b, int p) {
    uvec2 inPart = b.inPart + uvec2(p & 1, p >> 1);
    return ivec2(b.origin + inPart * b.interleave + uvec2(b.part % b.interleave, b.part / b.interleave));
}
#endif
