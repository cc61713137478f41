#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Where a surface is a few pixels wide no pixel near holds some parts of the far lights: they are gathered here.
layout(constant_id = 0) const uint kShape = 2;
layout(constant_id = 2) const uint kSide = 1;
#include "published/interleaved_shading/shared_maps.glsl"
#include "published/interleaved_shading/lacking.h"
#include "val_shading/gather_inputs.glsl"

layout(local_size_x_id = 100) in;  // one workgroup a tile, on CPU devices one subgroup
layout(set = 0, binding = 8, scalar) readonly buffer LackingCounts { uint items[]; } lackingCounts;
layout(set = 0, binding = 9, scalar) readonly buffer Lacking { uint items[]; } lacking;
layout(set = 0, binding = 10, rgba16f) uniform image2D irradiance;

Receiver receiverOf(ivec2 pixel) {
    mat4 worldFromClip = camera.camera.worldFromClip;
    vec3 position = worldFromPixel(worldFromClip, camera.camera.size, pixel, texelFetch(depthMap, pixel, 0).x);
    return Receiver(position, texelFetch(normalMap, pixel, 0).xyz, 0.0, vec3(0.0), vec3(0.0));
}

// Of the light that stands i-th in the tile's list.
void addIfLacking(AreaLight l, uint i, uint parts, inout Receiver r) {
    l.power.rgb *= float(parts >> i % (kSide * kSide) & 1u);
    addLight(l, push.p.ismTileSize, r);
}

void main() {
    uint tile = gl_WorkGroupID.x, pixels = lackingCounts.items[tile], count = counts.items[tile].y;
    uint start = listStart(tile, kFarList, push.p.valCount), side = push.p.tileSize;
    uvec2 origin = uvec2(tile % push.p.tiles.x, tile / push.p.tiles.x) * side;
    for (uint first = 0; first < pixels; first += gl_WorkGroupSize.x) {
        uint mine = first + gl_LocalInvocationID.x;
        uint packed = lacking.items[tile * side * side + min(mine, pixels - 1)];
        uint inTile = packed & ((1u << kLackingPixelBits) - 1u), parts = packed >> kLackingPixelBits;
        ivec2 pixel = ivec2(origin + uvec2(inTile % side, inTile / side));
        Receiver r = receiverOf(pixel);
        for (uint base = 0; base < count; base += kSubgroupSize) {
            if (kLaneParallel) {
                uint i = min(base + gl_SubgroupInvocationID, count - 1);
                AreaLight light = loadLight(fetchTexel(lists, int(start + i)).x);
                [[dont_unroll]] for (uint lane = 0; lane < min(kSubgroupSize, count - base); ++lane)
                    addIfLacking(lightOfLane(light, lane), base + lane, parts, r);
            } else {
                for (uint i = base; i < min(base + kSubgroupSize, count); ++i)
                    addIfLacking(loadLight(fetchTexel(lists, int(start + i)).x), i, parts, r);
            }
        }
        if (mine < pixels) {
            vec3 sum = imageLoad(irradiance, pixel).rgb + r.irradiance;
            imageStore(irradiance, pixel, vec4(min(sum, vec3(kMostHalf)), 1.0));
        }
    }
}
