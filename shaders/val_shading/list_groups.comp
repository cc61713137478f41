#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Lists the workgroups of gather_far.comp and gather_near.comp whose pixels are gathered anew: those that are due, and
// those any of whose surfaces is another. In any order.
#include "val_shading/screen_tiles.glsl"

layout(local_size_x = 64) in;  // as theirs
layout(push_constant, scalar) uniform Push { ValSharePush p; } push;
layout(set = 0, binding = 0) uniform sampler2D normalMap;
layout(set = 0, binding = 1) uniform sampler2D depthMap;
layout(set = 0, binding = 2, scalar) readonly buffer PreviousDigests { uvec2 items[]; } previousDigests;
layout(set = 0, binding = 3, scalar) writeonly buffer Digests { uvec2 items[]; } digests;
layout(set = 0, binding = 4, scalar) writeonly buffer Listed { uint items[]; } listed;
layout(set = 0, binding = 5, scalar) buffer Groups { uvec3 count; } groups;
#include "val_shading/digest.glsl"

void main() {
    if (gl_LocalInvocationIndex == 0) sharedDigest = uvec2(0);
    barrier();
    TileBlock block = tileBlock(gl_GlobalInvocationID.x, push.p.gather.tileSize, push.p.gather.tiles, 1);
    ivec2 size = textureSize(depthMap, 0);
    for (int p = 0; p < kPixels; ++p) {
        ivec2 pixel = pixelOf(block, p);
        if (block.spare || any(greaterThanEqual(pixel, size))) continue;
        addToDigest(gl_LocalInvocationIndex * kPixels + p,
                    surfaceWords(texelFetch(depthMap, pixel, 0).x, vec4(texelFetch(normalMap, pixel, 0).xyz, 0.0)));
    }
    barrier();
    if (gl_LocalInvocationIndex != 0) return;
    bool other = takeDigest(gl_WorkGroupID.x);
    if (other || isDue(block.tile)) listed.items[atomicAdd(groups.count.x, 1)] = gl_WorkGroupID.x;
}
