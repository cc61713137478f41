#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Irradiance from near lights, all of them at every pixel of their tile, on top of the far ones'.
layout(constant_id = 0) const uint kShape = 4;
#include "common/texels.glsl"
#include "val_shading/gather_inputs.glsl"

layout(local_size_x = 64) in;
layout(constant_id = 8) const bool kListed = false;  // else every workgroup
layout(set = 0, binding = 14) UINT_TEXELS(listed);
layout(set = 0, binding = 8) uniform sampler2D far;
layout(set = 0, binding = 9, rgba16f) uniform writeonly image2D irradiance;
layout(set = 0, binding = 12) uniform sampler2D farToward;
layout(set = 0, binding = 13, rgba16f) uniform writeonly image2D toward;

void addLightToAll(AreaLight l, inout Receiver r[kPixels]) {
    [[unroll]] for (int p = 0; p < kPixels; ++p) addLight(l, push.p.ismTileSize, r[p]);
}

void main() {
    uint group = kListed ? fetchTexel(listed, int(gl_WorkGroupID.x)).x : gl_WorkGroupID.x;
    TileBlock block = tileBlock(group * gl_WorkGroupSize.x + gl_LocalInvocationID.x, push.p.tileSize, push.p.tiles);
    ivec2 size = ivec2(camera.camera.size);
    float depth[kPixels];
    Receiver r[kPixels];
    [[unroll]] for (int p = 0; p < kPixels; ++p) {
        ivec2 pixel = min(pixelOf(block, p), size - 1);
        depth[p] = texelFetch(depthMap, pixel, 0).x;
        vec3 position = worldFromPixel(camera.camera.worldFromClip, uvec2(size), pixel, max(depth[p], 1e-9));
        r[p] = Receiver(position, texelFetch(normalMap, pixel, 0).xyz, widthOf(pixel, depth[p]), texelFetch(far, pixel, 0).rgb,
                        kDirected ? texelFetch(farToward, pixel, 0).xyz : vec3(0.0));
    }
    uint start = listStart(block.tile, kNearList, push.p.valCount), count = counts.items[block.tile].x;
    AG_MEET_LIGHTS(start, count, addLightToAll(l, r))
    [[unroll]] for (int p = 0; p < kPixels; ++p) {
        ivec2 pixel = pixelOf(block, p);
        if (any(greaterThanEqual(pixel, size))) continue;
        bool seen = depth[p] > 0.0;
        imageStore(irradiance, pixel, vec4(seen ? min(r[p].irradiance, vec3(kMostHalf)) : vec3(0.0), 1.0));
        // Relative: along the pixel's own normal it is about one.
        float all = r[p].irradiance.x + r[p].irradiance.y + r[p].irradiance.z;
        if (kDirected) imageStore(toward, pixel, vec4(r[p].toward / max(all, 1e-20), 0.0));
    }
}
