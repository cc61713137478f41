#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Lists the workgroups of gather_gloss.comp that have a pixel with a specular lobe, in any order; the others' is black.
#include "val_shading/screen_tiles.glsl"

layout(local_size_x = 64) in;  // as gather_gloss.comp
layout(push_constant, scalar) uniform Push { ValShadingPush p; } push;
layout(set = 0, binding = 0) uniform sampler2D reflectanceMap;
layout(set = 0, binding = 1, rgba16f) uniform writeonly image2D gloss;
layout(set = 0, binding = 2, scalar) writeonly buffer Glossy { uint items[]; } glossyGroups;
layout(set = 0, binding = 3, scalar) buffer Groups { uvec3 count; } groups;

shared uint anyGlossy;

void main() {
    if (gl_LocalInvocationIndex == 0) anyGlossy = 0;
    barrier();
    TileBlock block = tileBlock(gl_GlobalInvocationID.x, push.p.tileSize, push.p.tiles);
    ivec2 size = textureSize(reflectanceMap, 0);
    bool glossy = false;
    for (int p = 0; p < kPixels; ++p) {
        ivec2 pixel = pixelOf(block, p);
        if (block.spare || any(greaterThanEqual(pixel, size))) continue;
        glossy = glossy || any(greaterThan(texelFetch(reflectanceMap, pixel, 0), vec4(0.0)));
    }
    if (glossy) anyGlossy = 1;
    barrier();
    if (anyGlossy == 1) {
        if (gl_LocalInvocationIndex == 0) glossyGroups.items[atomicAdd(groups.count.x, 1)] = gl_WorkGroupID.x;
        return;
    }
    for (int p = 0; p < kPixels; ++p) {
        ivec2 pixel = pixelOf(block, p);
        if (block.spare || any(greaterThanEqual(pixel, size))) continue;
        imageStore(gloss, pixel, vec4(0.0));
    }
}
