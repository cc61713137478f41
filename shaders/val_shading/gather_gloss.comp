#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// What gloss adds to the light of one of a tile's lists, at the pixels that are gathered. Only workgroups that were listed as having a pixel with a specular lobe.
#define AG_GLOSSY
layout(constant_id = 0) const uint kShape = 4;
layout(constant_id = 5) const uint kList = 0;
#include "common/texels.glsl"
#include "val_shading/gather_inputs.glsl"
#include "val_shading/glossy_pixel.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 10, rgba16f) uniform image2D gloss;
layout(set = 0, binding = 11) UINT_TEXELS(listed);

void addGlossToAll(AreaLight l, inout GlossyPixel g[kPixels]) {
    [[unroll]] for (int p = 0; p < kPixels; ++p) addGloss(l, g[p]);
}

void addLights(TileBlock block, inout GlossyPixel g[kPixels]) {
    uint start = listStart(block.tile, kList, push.p.valCount), count = counts.items[block.tile][kList];
    AG_MEET_LIGHTS(start, count, addGlossToAll(l, g))
}

void main() {
    uint group = fetchTexel(listed, int(gl_WorkGroupID.x)).x;
    TileBlock block = tileBlock(group * gl_WorkGroupSize.x + gl_LocalInvocationID.x, push.p.tileSize, push.p.tiles);
    ivec2 size = ivec2(camera.camera.size);
    GlossyPixel g[kPixels];
    [[unroll]] for (int p = 0; p < kPixels; ++p) g[p] = glossyPixelAt(min(pixelOf(block, p), size - 1));
    addLights(block, g);
    [[unroll]] for (int p = 0; p < kPixels; ++p) {
        ivec2 pixel = pixelOf(block, p);
        if (block.spare || any(greaterThanEqual(pixel, size))) continue;
        vec3 radiance = g[p].radiance + (kList == kNearList ? vec3(0.0) : imageLoad(gloss, pixel).rgb);  // near ones come first
        imageStore(gloss, pixel, vec4(g[p].glossy ? min(radiance, vec3(kMostHalf)) : vec3(0.0), 1.0));
    }
}
