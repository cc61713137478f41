#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// What gloss adds to the light of one of a tile's lists, at the pixels that are gathered. Only workgroups that were listed as having a pixel with a specular lobe.
#define AG_GLOSSY
layout(constant_id = 0) const uint kShape = 4;
layout(constant_id = 5) const uint kList = 0;
#include "common/texels.glsl"
#include "val_shading/gather_inputs.glsl"
#include "val_shading/gloss.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 8) uniform sampler2D albedoMap;
layout(set = 0, binding = 9) uniform sampler2D reflectanceMap;
layout(set = 0, binding = 10, rgba16f) uniform image2D gloss;
layout(set = 0, binding = 11) UINT_TEXELS(listed);

struct GlossyPixel {
    Receiver receiver;
    Specular specular;
    bool glossy;
    vec3 radiance;  // sum, W/(m² sr)
};

GlossyPixel glossyPixelAt(ivec2 pixel) {
    float depth = texelFetch(depthMap, pixel, 0).x;
    vec4 normalAndRoughness = texelFetch(normalMap, pixel, 0), reflectance = texelFetch(reflectanceMap, pixel, 0);
    vec3 x = worldFromPixel(camera.camera.worldFromClip, camera.camera.size, pixel, depth);
    GlossyPixel g;
    g.receiver = Receiver(x, normalAndRoughness.xyz, kList == kNearList ? widthOf(pixel, depth) : 0.0, vec3(0.0), vec3(0.0));
    g.specular = specularOf(normalize(camera.camera.position - x), normalAndRoughness.w, reflectance, texelFetch(albedoMap, pixel, 0).rgb);
    g.glossy = depth > 0.0 && any(greaterThan(reflectance, vec4(0.0)));
    g.radiance = vec3(0.0);
    return g;
}

void addGloss(AreaLight l, inout GlossyPixel g) {
    Receiver r = g.receiver;
    vec3 e = irradianceFrom(l, r.position, r.normal, r.width, push.p.ismTileSize);
    g.radiance += specularRadiance(g.specular, r.position, r.normal, l, e);
}

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
