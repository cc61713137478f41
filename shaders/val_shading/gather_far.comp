#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Irradiance from a tile's far lights; four pixels an invocation share the loads.
layout(constant_id = 0) const uint kShape = 2;
#include "common/texels.glsl"
#include "val_shading/gather_inputs.glsl"

layout(local_size_x = 64) in;
layout(constant_id = 8) const bool kListed = false;  // else every workgroup
layout(set = 0, binding = 10) UINT_TEXELS(listed);
layout(set = 0, binding = 8, rgba16f) uniform writeonly image2D far;
layout(set = 0, binding = 9, rgba16f) uniform writeonly image2D farToward;

void main() {
    uint group = kListed ? fetchTexel(listed, int(gl_WorkGroupID.x)).x : gl_WorkGroupID.x;
    TileBlock block = tileBlock(group * gl_WorkGroupSize.x + gl_LocalInvocationID.x, push.p.tileSize, push.p.tiles);
    uvec2 size = camera.camera.size;
    Receiver r[kPixels];
    float distance_[kPixels];  // m along the camera's axis; 0: sky
    [[unroll]] for (int p = 0; p < kPixels; ++p) {
        ivec2 pixel = min(pixelOf(block, p), ivec2(size) - 1);
        float depth = texelFetch(depthMap, pixel, 0).x;
        distance_[p] = depth > 0.0 ? camera.camera.near / depth : 0.0;
        r[p] = Receiver(worldFromPixel(camera.camera.worldFromClip, size, pixel, depth), texelFetch(normalMap, pixel, 0).xyz, 0.0,
                        vec3(0.0), vec3(0.0));
    }
    uint start = listStart(block.tile, kFarList, push.p.valCount), count = counts.items[block.tile].y;
    if (kLaneParallel) {
        for (uint base = 0; base < count; base += kSubgroupSize) {
            uint entry = base + gl_SubgroupInvocationID;
            AreaLight mine = loadLight(fetchTexel(lists, int(start + min(entry, count - 1))).x);
            if (entry >= count) mine.power = vec4(0.0);
            [[unroll]] for (uint lane = 0; lane < kSubgroupSize; ++lane) {
                AreaLight l = lightOfLane(mine, lane);
                [[unroll]] for (int p = 0; p < kPixels; ++p) addLight(l, push.p.ismTileSize, r[p]);
            }
        }
    } else {
        for (uint entry = 0; entry < count; ++entry) {
            AreaLight l = loadLight(fetchTexel(lists, int(start + entry)).x);
            [[unroll]] for (int p = 0; p < kPixels; ++p) addLight(l, push.p.ismTileSize, r[p]);
        }
    }
    [[unroll]] for (int p = 0; p < kPixels; ++p) {
        ivec2 pixel = pixelOf(block, p);
        if (any(greaterThanEqual(pixel, ivec2(size)))) continue;
        imageStore(far, pixel, vec4(min(r[p].irradiance, vec3(kMostHalf)), distance_[p]));
        if (kDirected) imageStore(farToward, pixel, vec4(clamp(r[p].toward, vec3(-kMostHalf), vec3(kMostHalf)), 0.0));
    }
}
