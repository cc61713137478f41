#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Gloss of pixels that reflect like none of the cells about them: the lights of one list of the tile of cells they lie in.
#define AG_GLOSSY
layout(constant_id = 0) const uint kShape = 4;
layout(constant_id = 5) const uint kList = 0;
layout(constant_id = 8) const uint kSpacing = 1;  // pixels from a cell to the next
#include "common/listed_pixel.glsl"
#include "common/texels.glsl"
#include "val_shading/gather_inputs.glsl"
#include "val_shading/glossy_pixel.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 10, scalar) readonly buffer Alone { uint count; uint pixels[]; } alone;
layout(set = 0, binding = 11, rgba16f) uniform image2D result;

uint tileOf(ivec2 pixel) {
    uvec2 tile = min(uvec2(pixel) / (kSpacing * push.p.tileSize), push.p.tiles - 1u);
    return tile.y * push.p.tiles.x + tile.x;
}

void main() {
    if (gl_GlobalInvocationID.x >= alone.count) return;
    ivec2 pixel = listedPixel(alone.pixels[gl_GlobalInvocationID.x]);
    GlossyPixel g = glossyPixelAt(pixel);
    uint tile = tileOf(pixel), start = listStart(tile, kList, push.p.valCount), count = counts.items[tile][kList];
    for (uint i = 0; i < count; ++i) addGloss(loadLight(fetchTexel(lists, int(start + i)).x), g);
    vec3 radiance = g.radiance + (kList == kNearList ? vec3(0.0) : imageLoad(result, pixel).rgb);  // near ones come first
    imageStore(result, pixel, vec4(min(radiance, vec3(kMostHalf)), 1.0));
}
