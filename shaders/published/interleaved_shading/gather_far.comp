#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Irradiance from far lights. Of each n x n pixels of a tile each takes another n²-th of the tile's list (Wald et al.
// 2002; ACRSM section 3.2.3); four pixels an invocation share the loads.
layout(constant_id = 0) const uint kShape = 2;
layout(constant_id = 2) const uint kSide = 1;
#include "published/interleaved_shading/shared_maps.glsl"
#include "val_shading/gather_inputs.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 8, rgba16f) uniform writeonly image2D parts;

// Four pixels of a part of a tile. A part is every kSide-th pixel of each row and column; a tile's invocations go part
// after part.
struct PartBlock {
    uint tile, part;
    uvec2 origin;  // of the tile
    uvec2 inPart;  // of the first pixel among its part's
};

PartBlock partBlock(uint invocation, uint tileSize, uvec2 tiles) {
    uint perTile = blocksOfTile(tileSize), side = tileSize / kSide / 2, perPart = side * side, block = invocation % perPart;
    PartBlock b;
    b.tile = min(invocation / perTile, tiles.x * tiles.y - 1);
    b.part = invocation % perTile / perPart;
    b.origin = uvec2(b.tile % tiles.x, b.tile / tiles.x) * tileSize;
    b.inPart = uvec2(block % side, block / side) * 2;
    return b;
}

ivec2 pixelOf(PartBlock b, int p) {
    uvec2 inPart = b.inPart + uvec2(p & 1, p >> 1);
    return ivec2(b.origin + inPart * kSide + uvec2(b.part % kSide, b.part / kSide));
}

void main() {
    PartBlock block = partBlock(gl_GlobalInvocationID.x, push.p.tileSize, push.p.tiles);
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
    const uint kParts = kSide * kSide;
    uint start = listStart(block.tile, kFarList, push.p.valCount), count = counts.items[block.tile].y;
    if (kLaneParallel) {
        for (uint base = block.part; base < count; base += kSubgroupSize * kParts) {
            uint entry = base + gl_SubgroupInvocationID * kParts;
            AreaLight mine = loadLight(fetchTexel(lists, int(start + min(entry, count - 1))).x);
            if (entry >= count) mine.power = vec4(0.0);
            [[unroll]] for (uint lane = 0; lane < kSubgroupSize; ++lane) {
                AreaLight l = lightOfLane(mine, lane);
                [[unroll]] for (int p = 0; p < kPixels; ++p) addLight(l, push.p.ismTileSize, r[p]);
            }
        }
    } else {
        for (uint entry = block.part; entry < count; entry += kParts) {
            AreaLight l = loadLight(fetchTexel(lists, int(start + entry)).x);
            [[unroll]] for (int p = 0; p < kPixels; ++p) addLight(l, push.p.ismTileSize, r[p]);
        }
    }
    [[unroll]] for (int p = 0; p < kPixels; ++p) {
        ivec2 pixel = pixelOf(block, p);
        if (any(greaterThanEqual(pixel, ivec2(size)))) continue;
        imageStore(parts, pixel, vec4(min(r[p].irradiance, vec3(kMostHalf)), distance_[p]));
    }
}
