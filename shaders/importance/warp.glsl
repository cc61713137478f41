// Points warped by importance (RSMC section 4; ACRSM algorithm 5.3): to a face of a map, a block of it, and a lit texel.
// Needs buffers `texels`, `faces` and `pyramid`.
#ifndef AG_WARP_GLSL
#define AG_WARP_GLSL

#include "importance/pyramid.glsl"

// Splits u in proportion a : b; returns 0 or 1 and stretches u over the chosen part.
uint splitUnit(inout float u, float a, float b) {
    float total = a + b;
    float share = total > 0.0 ? a / total : 0.5;
    uint second = u < share ? 0u : 1u;
    u = second == 0u ? u / max(share, 1e-12) : (u - share) / max(1.0 - share, 1e-12);
    u = clamp(u, 0.0, 0.99999994);
    return second;
}

float faceImportance(uint face, uint pyramidStride) {
    uint top = pyramidTopLevel(faces.items[face].size);
    return pyramid.items[face * pyramidStride + pyramidLevelOffset(top, top)];
}

float mapImportance(RsmMap map, uint pyramidStride) {
    float total = 0.0;
    for (uint i = 0; i < map.faceCount; ++i) total += faceImportance(map.firstFace + i, pyramidStride);
    return total;
}

uint chooseFace(RsmMap map, uint pyramidStride, inout float u) {
    float rest = u * mapImportance(map, pyramidStride);
    uint chosen = map.firstFace;
    for (uint i = 0; i < map.faceCount; ++i) {
        float share = faceImportance(map.firstFace + i, pyramidStride);
        if (rest >= 0.0 && share > 0.0) {
            chosen = map.firstFace + i;
            u = clamp(rest / share, 0.0, 0.99999994);
        }
        rest -= share;
    }
    return chosen;
}

// Down the 2x2 hierarchy, first rows then columns.
uvec2 warpToBlock(uint face, uint pyramidStride, inout vec2 u) {
    uint top = pyramidTopLevel(faces.items[face].size);
    uint base = face * pyramidStride;
    uint node = 0;
    for (uint level = top; level > 0; --level) {
        uint child = base + pyramidLevelOffset(top, level - 1) + 4 * node;
        float c0 = pyramid.items[child], c1 = pyramid.items[child + 1];
        float c2 = pyramid.items[child + 2], c3 = pyramid.items[child + 3];
        uint row = splitUnit(u.y, c0 + c1, c2 + c3);
        uint column = row == 0 ? splitUnit(u.x, c0, c1) : splitUnit(u.x, c2, c3);
        node = 4 * node + 2 * row + column;
    }
    return cellFromMorton(node);
}

// The texel of the block under u, or the next lit one after it.
uint litTexelOfBlock(uint atlasWidth, uint face, uvec2 block, vec2 u) {
    uint side = blockSide(faces.items[face].size), count = side * side;
    uvec2 origin = faces.items[face].origin + block * side;
    uvec2 cell = uvec2(u * float(side));
    uint start = cell.y * side + cell.x;
    uint found = kNoCluster;
    for (uint i = 0; i < count; ++i) {
        uint place = (start + i) % count;
        uvec2 coord = origin + uvec2(place % side, place / side);
        uint index = rsmIndexOfCoord(coord, atlasWidth);
        if (found == kNoCluster && fetchTexel(texels, int(index) * 3 + 1).w > 0.0) found = index;
    }
    return found;
}
#endif
