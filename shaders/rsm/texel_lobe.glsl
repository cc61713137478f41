// Where a texel of a reflective shadow map sends its light: a glossy surface more to where it mirrors the map's light, less to
// elsewhere. Before: `maps`, `tileMaps`, sampler2D rsmNormals and rsmAlbedos (render.frag), the constant kTexelLobes.
#ifndef AG_TEXEL_LOBE_GLSL
#define AG_TEXEL_LOBE_GLSL

#include "common/brdf.h"
#include "rsm/rsm.glsl"
#include "val_shading/lobe.glsl"

const uint kTileTexels = kRsmTileSize * kRsmTileSize;

// Texels of tiles without a map (~0) are dark.
uint mapOfTexel(uint texel) { return min(tileMaps.items[texel / kTileTexels], kMaxRsmMaps - 1); }

// Over what a diffuse surface would send. `toward`: from the texel's place, unit.
vec3 sentToward(uint texel, vec3 place, vec3 normal, vec3 toward, uint atlasWidth) {
    if (!kTexelLobes) return vec3(1.0);
    RsmMap map = maps.items[mapOfTexel(texel)];
    if (map.kind == kMapOfSurfaces) return vec3(1.0);
    ivec2 coord = ivec2(rsmTexelCoord(texel / kTileTexels, texel % kTileTexels, atlasWidth));
    vec4 whole = texelFetch(rsmAlbedos, coord, 0);
    if (whole.a <= 0.0) return vec3(1.0);
    // Narrower lobes would make few texels very bright.
    float roughness = max(texelFetch(rsmNormals, coord, 0).a, kLeastRoughness);
    vec3 d = map.position - place, toLight = map.kind == kLightDirectional ? -map.direction : d / max(length(d), 1e-6);
    return shareOfDirection(whole, roughness, normal, toward, toLight);
}

vec3 sentTo(vec3 receiver, uint texel, RsmSurface s, uint atlasWidth) {
    vec3 d = receiver - s.position;
    return sentToward(texel, s.position, s.normal, d / max(length(d), 1e-6), atlasWidth);
}
#endif
