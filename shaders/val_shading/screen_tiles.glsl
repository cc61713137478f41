// Pixels by tiles: where an invocation's 2 x 2 pixels lie.
#ifndef AG_SCREEN_TILES_GLSL
#define AG_SCREEN_TILES_GLSL

#include "gbuffer/gbuffer.glsl"
#include "val_shading/light_lists.glsl"

const int kPixels = 4;

struct TileBlock {
    uint tile;
    uvec2 origin;  // of the tile
    uvec2 inTile;  // of the first pixel
    bool spare;    // beyond the last tile's, which fill up a workgroup: does what another does
};

uint blocksOfTile(uint tileSize) { return tileSize * tileSize / 4; }

TileBlock tileBlock(uint invocation, uint tileSize, uvec2 tiles) {
    uint perTile = blocksOfTile(tileSize), side = tileSize / 2, block = invocation % perTile;
    TileBlock b;
    b.spare = invocation >= perTile * tiles.x * tiles.y;
    b.tile = min(invocation / perTile, tiles.x * tiles.y - 1);
    b.origin = uvec2(b.tile % tiles.x, b.tile / tiles.x) * tileSize;
    b.inTile = uvec2(block % side, block / side) * 2;
    return b;
}

ivec2 pixelOf(TileBlock b, int p) { return ivec2(b.origin + b.inTile + uvec2(p & 1, p >> 1)); }
#endif
