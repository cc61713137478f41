#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Of the workgroups that list_gloss.comp listed those that are gathered anew: those that are due, and those any of whose
// surfaces is another. In any order.
#include "val_shading/screen_tiles.glsl"

layout(local_size_x = 64) in;  // as gather_gloss.comp
layout(push_constant, scalar) uniform Push { ValSharePush p; } push;
layout(set = 0, binding = 0) uniform sampler2D normalMap;
layout(set = 0, binding = 1) uniform sampler2D depthMap;
layout(set = 0, binding = 2) uniform sampler2D albedoMap;
layout(set = 0, binding = 3) uniform sampler2D reflectanceMap;
layout(set = 0, binding = 4, scalar) readonly buffer PreviousDigests { uvec2 items[]; } previousDigests;
layout(set = 0, binding = 5, scalar) writeonly buffer Digests { uvec2 items[]; } digests;
layout(set = 0, binding = 6) uniform usamplerBuffer glossyGroups;
layout(set = 0, binding = 7, scalar) writeonly buffer Listed { uint items[]; } listed;
layout(set = 0, binding = 8, scalar) buffer Groups { uvec3 count; } groups;
#include "val_shading/digest.glsl"

uvec4 coatWords(vec4 albedo, vec4 reflectance) {
    return uvec4(packHalf2x16(albedo.xy), packHalf2x16(albedo.zw), packHalf2x16(reflectance.xy), packHalf2x16(reflectance.zw));
}

void main() {
    if (gl_LocalInvocationIndex == 0) sharedDigest = uvec2(0);
    barrier();
    uint group = texelFetch(glossyGroups, int(gl_WorkGroupID.x)).x;
    TileBlock block = tileBlock(group * gl_WorkGroupSize.x + gl_LocalInvocationID.x, push.p.gather.tileSize, push.p.gather.tiles, 1);
    ivec2 size = textureSize(reflectanceMap, 0);
    for (int p = 0; p < kPixels; ++p) {
        ivec2 pixel = pixelOf(block, p);
        if (block.spare || any(greaterThanEqual(pixel, size))) continue;
        uint place = (gl_LocalInvocationIndex * kPixels + p) * 2;
        addToDigest(place, surfaceWords(texelFetch(depthMap, pixel, 0).x, texelFetch(normalMap, pixel, 0)));
        addToDigest(place + 1, coatWords(texelFetch(albedoMap, pixel, 0), texelFetch(reflectanceMap, pixel, 0)));
    }
    barrier();
    if (gl_LocalInvocationIndex != 0) return;
    bool other = takeDigest(group);
    if (other || isDue(block.tile)) listed.items[atomicAdd(groups.count.x, 1)] = group;
}
