#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// What the area light that a pixel drew sends to it as the gather of all area lights has it, over how likely it was drawn:
// as the mean over draws that gather's sum, so that what this number and that of the rays have in common is known.
layout(constant_id = 0) const uint kShape = 4;
#include "common/texels.glsl"
#include "texel_rays/texel_rays_io.h"
#include "val_shading/gather_inputs.glsl"

layout(local_size_x = 64) in;
layout(constant_id = 8) const uint kList = kNearList;  // the near one adds to what the far one wrote
layout(set = 0, binding = 8) uniform sampler2D sent;
layout(set = 0, binding = 9) FLOAT_TEXELS(likely);
layout(set = 0, binding = 10, rgba32f) uniform image2D control;  // W/m²

void main() {
    uvec2 size = camera.camera.size;
    uint index = gl_GlobalInvocationID.x;
    ivec2 pixel = ivec2(index % size.x, index / size.x);
    if (index >= size.x * size.y) return;
    uint drawn = uint(max(texelFetch(sent, pixel, 0).w, 0.0));
    uvec2 tile = uvec2(pixel) / push.p.tileSize, block = uvec2(pixel) / kDrawBlock;
    uint inBlocks = block.y * ((size.x + kDrawBlock - 1) / kDrawBlock) + block.x;
    uint inTiles = tile.y * push.p.tiles.x + tile.x, nearCount = counts.items[inTiles].x;
    bool near = drawn <= nearCount, met = drawn > 0 && drawn <= nearCount + counts.items[inTiles].y;
    if (!met || near != (kList == kNearList)) {
        if (kList == kFarList) imageStore(control, pixel, vec4(0.0));
        return;
    }
    uint entry = drawn - 1 - (near ? 0 : nearCount);
    uint light = fetchTexel(lists, int(listStart(inTiles, kList, push.p.valCount) + entry)).x;
    float depth = texelFetch(depthMap, pixel, 0).x, width = kList == kNearList ? widthOf(pixel, depth) : 0.0;
    vec3 place = worldFromPixel(camera.camera.worldFromClip, size, pixel, depth), normal = texelFetch(normalMap, pixel, 0).xyz;
    vec3 e = irradianceFrom(loadLight(light), place, normal, width, push.p.ismTileSize);
    imageStore(control, pixel, vec4(e / fetchTexel(likely, int(inBlocks * push.p.valCount + light)).x, 0.0));
}
