// Access to RSM texels and tiles for the passes that read them.
#ifndef AG_RSM_GLSL
#define AG_RSM_GLSL

#include "common/lights.h"
#include "rsm/rsm_io.h"
#include "scene/scene_io.h"

const float kSameSurface = 0.99;  // cosine of two texels' normals

struct RsmSurface {
    vec3 position, normal, flux;
    float area, weight, cosine;
};

#define AG_RSM_FETCH(texels, index) fetchRsmTexel_(fetchTexel(texels, int(index) * 3), fetchTexel(texels, int(index) * 3 + 1), fetchTexel(texels, int(index) * 3 + 2))

RsmSurface fetchRsmTexel_(vec4 a, vec4 b, vec4 c) { return RsmSurface(a.xyz, b.xyz, c.xyz, a.w, b.w, c.w); }

// Of a map's light on a surface that nothing hides from it, W/m².
vec3 irradianceOf(RsmMap map, vec3 place, vec3 normal) {
    if (map.kind == kLightDirectional) return map.intensity * max(-dot(normal, map.direction), 0.0);
    vec3 d = place - map.position;
    float distance_ = max(length(d), 1e-6);
    vec3 away = d / distance_;
    float facing = punctualIrradiance(away, distance_, map.direction, map.cosInner, map.cosOuter, map.range);
    return map.intensity * (facing * max(-dot(normal, away), 0.0));
}

// Whether what a face shows at a place, in texels, belongs to the map of another level.
bool inHole(RsmMap map, vec2 at) {
    return all(greaterThanEqual(at, vec2(map.holeBegin))) && all(lessThan(at, vec2(map.holeBegin + map.holeSize)));
}

// Texels are stored tile by tile, so that a tile's 256 lie together: index of a texel by its tile and its place.
uint rsmTexelIndex(uint tile, uint inTile) { return tile * (kRsmTileSize * kRsmTileSize) + inTile; }

uint rsmTileOfCoord(uvec2 coord, uint atlasWidth) {
    uvec2 tile = coord / kRsmTileSize;
    return tile.y * (atlasWidth / kRsmTileSize) + tile.x;
}

uint rsmIndexOfCoord(uvec2 coord, uint atlasWidth) {
    uvec2 inTile = coord % kRsmTileSize;
    return rsmTexelIndex(rsmTileOfCoord(coord, atlasWidth), inTile.y * kRsmTileSize + inTile.x);
}

uvec2 rsmTexelCoord(uint tile, uint inTile, uint atlasWidth) {
    uint tilesX = atlasWidth / kRsmTileSize;
    return uvec2(tile % tilesX, tile / tilesX) * kRsmTileSize +
           uvec2(inTile % kRsmTileSize, inTile / kRsmTileSize);
}

// Of a texel of the atlas in one of its faces, stored tile by tile by itself.
uint rsmIndexInFace(uint texel, RsmFace face, uint atlasWidth) {
    const uint kTileTexels = kRsmTileSize * kRsmTileSize;
    uvec2 tile = (rsmTexelCoord(texel / kTileTexels, 0, atlasWidth) - face.origin) / kRsmTileSize;
    return rsmTexelIndex(tile.y * (face.size / kRsmTileSize) + tile.x, texel % kTileTexels);
}
#endif
