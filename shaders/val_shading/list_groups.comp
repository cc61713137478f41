#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Lists the workgroups of a gathering whose pixels are gathered anew: those that are due, and those any of whose
// surfaces is another than when they were gathered last. In any order. Of the groups of gather_gloss.comp only those
// that have a specular lobe.
#include "common/sampling.h"
#include "common/texels.glsl"
#include "val_shading/screen_tiles.glsl"

layout(local_size_x = 64) in;  // as the gathering
layout(push_constant, scalar) uniform Push { ValSharePush p; } push;
layout(constant_id = 0) const bool kGlossy = false;  // of the groups listed, with all that a specular lobe is
layout(set = 0, binding = 0) uniform sampler2D normalMap;
layout(set = 0, binding = 1) uniform sampler2D depthMap;
layout(set = 0, binding = 2) uniform sampler2D albedoMap;
layout(set = 0, binding = 3) uniform sampler2D reflectanceMap;
layout(set = 0, binding = 4) UINT_TEXELS(glossyGroups);
layout(set = 0, binding = 5, scalar) readonly buffer PreviousDigests { uvec2 items[]; } previousDigests;
layout(set = 0, binding = 6, scalar) writeonly buffer Digests { uvec2 items[]; } digests;
layout(set = 0, binding = 7, scalar) writeonly buffer Listed { uint items[]; } listed;
layout(set = 0, binding = 8, scalar) buffer Groups { uvec3 count; } groups;

// Of all that the group's pixels are, in any order: sums of well mixed words. Two, as one in four billion changes would be
// missed by one.
shared uvec2 digest;

void addToDigest(uint place, uvec4 what) {
    uint a = hashUint(place + 1u);
    for (int i = 0; i < 4; ++i) a = hashUint(a ^ what[i]);
    atomicAdd(digest.x, a);
    atomicAdd(digest.y, hashUint(a ^ what.x ^ 0x9e3779b9u));
}

uvec2 halves(vec4 v) { return uvec2(packHalf2x16(v.xy), packHalf2x16(v.zw)); }

void addPixel(uint place, ivec2 pixel) {
    vec4 normal = texelFetch(normalMap, pixel, 0);  // and roughness
    if (!kGlossy) normal.w = 0.0;
    addToDigest(place * 2, uvec4(floatBitsToUint(texelFetch(depthMap, pixel, 0).x), halves(normal), 0u));
    if (kGlossy) addToDigest(place * 2 + 1, uvec4(halves(texelFetch(albedoMap, pixel, 0)), halves(texelFetch(reflectanceMap, pixel, 0))));
}

// Of every count-th tile the index-th ones: no two next to each other, in no row or column.
bool isDue(uint tile) {
    uvec2 at = uvec2(tile % push.p.gather.tiles.x, tile / push.p.gather.tiles.x);
    return (at.x + 2u * at.y) % push.p.count == push.p.index;
}

void main() {
    if (gl_LocalInvocationIndex == 0) digest = uvec2(0);
    barrier();
    uint group = kGlossy ? fetchTexel(glossyGroups, int(gl_WorkGroupID.x)).x : gl_WorkGroupID.x;
    TileBlock block = tileBlock(group * gl_WorkGroupSize.x + gl_LocalInvocationID.x, push.p.gather.tileSize, push.p.gather.tiles);
    ivec2 size = textureSize(depthMap, 0);
    for (int p = 0; p < kPixels; ++p) {
        ivec2 pixel = pixelOf(block, p);
        if (block.spare || any(greaterThanEqual(pixel, size))) continue;
        addPixel(gl_LocalInvocationIndex * kPixels + p, pixel);
    }
    barrier();
    if (gl_LocalInvocationIndex != 0) return;
    bool other = previousDigests.items[group] != digest;
    digests.items[group] = digest;
    if (other || isDue(block.tile)) listed.items[atomicAdd(groups.count.x, 1)] = group;
}
